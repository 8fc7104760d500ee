#include "logging/study/best_list.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "engine/core/regular_file.hpp"
#include "engine/document/json.hpp"
#include "engine/document/text_file.hpp"

namespace septet::logging {
namespace {

using document::Json;

auto no_best_list(const std::filesystem::path& path) {
  return failure("this file is no best list", path.string(), "move it away");
}

Expected<void> write_best_list(const std::filesystem::path& path, const std::vector<BestListEntry>& entries) {
  Json list = Json::array();
  for (const BestListEntry& entry : entries)
    list.push_back({{"game", entry.game},
                    {"participant", entry.participant},
                    {"points", document::number(entry.points)},
                    {"level", entry.level},
                    {"survived_s", document::number(entry.survived_s)},
                    {"end", entry.end},
                    {"started_utc", entry.started_utc}});
  return document::write_text_file(path, document::text_of(Json{{"best_list", std::move(list)}}));
}

}  // namespace

Expected<std::vector<BestListEntry>> read_best_list(const std::filesystem::path& path) {
  std::vector<BestListEntry> entries;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return entries;
  const auto text = read_regular_file(path);
  if (!text) return tl::unexpected(text.error());
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.contains("best_list") || !json["best_list"].is_array()) return no_best_list(path);
  for (const Json& row : json["best_list"]) {
    const auto is_text = [&](const char* key) { return row.contains(key) && row[key].is_string(); };
    const auto is_number = [&](const char* key) { return row.contains(key) && row[key].is_number(); };
    if (!row.is_object() || !is_text("game") || !is_text("participant") || !is_text("end") || !is_text("started_utc") ||
        !is_number("points") || !is_number("survived_s") || !row.contains("level") ||
        !row["level"].is_number_unsigned())
      return no_best_list(path);
    entries.push_back({row["game"].get<std::string>(), row["participant"].get<std::string>(),
                       row["points"].get<double>(), row["survived_s"].get<double>(), row["level"].get<std::uint32_t>(),
                       row["end"].get<std::string>(), row["started_utc"].get<std::string>()});
  }
  return entries;
}

Expected<std::size_t> enter_best_list(const std::filesystem::path& path, const BestListEntry& entry) {
  auto entries = read_best_list(path);
  if (!entries) return tl::unexpected(entries.error());
  const auto better = [&](const BestListEntry& other) {
    return other.game == entry.game && other.points >= entry.points;
  };
  const auto place = static_cast<std::size_t>(std::ranges::count_if(*entries, better)) + 1;
  entries->push_back(entry);
  std::ranges::stable_sort(*entries, [](const BestListEntry& a, const BestListEntry& b) {
    return a.game != b.game ? a.game < b.game : a.points > b.points;
  });
  std::size_t kept = 0;
  std::erase_if(*entries,
                [&](const BestListEntry& other) { return other.game == entry.game && ++kept > longest_best_list; });
  if (auto written = write_best_list(path, *entries); !written) return tl::unexpected(written.error());
  return place;
}

Expected<std::size_t> forget_in_best_list(const std::filesystem::path& path, const std::string& participant) {
  auto entries = read_best_list(path);
  if (!entries) return tl::unexpected(entries.error());
  const std::size_t gone =
      std::erase_if(*entries, [&](const BestListEntry& entry) { return entry.participant == participant; });
  if (gone == 0) return gone;
  if (auto written = write_best_list(path, *entries); !written) return tl::unexpected(written.error());
  return gone;
}

}  // namespace septet::logging

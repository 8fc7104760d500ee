#include "logging/session/subject.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "engine/core/printable.hpp"

namespace septet::logging {
namespace {

constexpr std::size_t most_characters = 500;
constexpr std::string_view column_prefix = "column.";

using Field = std::pair<std::string_view, std::string Subject::*>;
constexpr std::array<Field, 5> fields{Field{"group", &Subject::group}, Field{"condition", &Subject::condition},
                                      Field{"order", &Subject::order}, Field{"part", &Subject::part},
                                      Field{"note", &Subject::note}};

}  // namespace

Subject subject_of(const SessionInfo& info) {
  Subject subject;
  subject.participant = info.participant;
  for (const auto& [key, value] : info.other) {
    for (const auto& [name, field] : fields)
      if (key == name) subject.*field = value;
    if (key.starts_with(column_prefix)) subject.columns[key.substr(column_prefix.size())] = value;
  }
  return subject;
}

std::map<std::string, std::string> meta_of(const Subject& subject) {
  std::map<std::string, std::string> meta;
  for (const auto& [name, field] : fields)
    if (!(subject.*field).empty()) meta[std::string(name)] = subject.*field;
  for (const auto& [name, value] : subject.columns) meta[std::string(column_prefix) + name] = value;
  return meta;
}

Expected<void> add_to_subject(Subject& subject, const std::string& text) {
  const auto equals = text.find('=');
  const std::string key = text.substr(0, equals);
  const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
  const auto characters = printable_characters(value);
  const auto key_characters = printable_characters(key);
  if (!characters || *characters > most_characters || !key_characters || *key_characters > most_characters)
    return failure(fmt::format("\"{}\" cannot be kept with the drive", printable(text)), printable(key, 40),
                   fmt::format("use at most {} characters, none of them a control character", most_characters));
  for (const auto& [name, field] : fields)
    if (key == name) {
      if (key == "order" && !value.empty() && !is_order(value))
        return failure(fmt::format("\"{}\" is no place in an order", printable(value, 60)), "order",
                       "give a whole number from 1 on: 1 for the driver's first drive");
      subject.*field = value;
      return {};
    }
  if (!key.starts_with(column_prefix) || key.size() == column_prefix.size() || equals == std::string::npos)
    return failure(fmt::format("nothing is known of a drive by the name \"{}\"", printable(key)), printable(text, 60),
                   "give a column of your own as NAME=VALUE");
  subject.columns[key.substr(column_prefix.size())] = value;
  return {};
}

bool is_order(std::string_view text) {
  return !text.empty() && text.size() <= 9 && text.front() != '0' &&
         std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

bool is_personal(const std::string& meta_key) {
  return meta_key == "participant" || meta_key == "note" || meta_key.starts_with(column_prefix);
}

}  // namespace septet::logging

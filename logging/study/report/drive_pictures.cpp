#include "logging/study/report/drive_pictures.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "engine/document/markup.hpp"
#include "engine/rig/rig.hpp"
#include "logging/study/report/page_link.hpp"

namespace septet::logging {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_moments = 6;

/// Folder of the screen whose pictures are shown, and their ticks.
std::pair<fs::path, std::vector<std::int64_t>> screen_of(const SessionInfo& info, const fs::path& session_folder) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator entry(session_folder / "screens", error), end; !error && entry != end;
       entry.increment(error))
    if (std::error_code ignored; entry->is_directory(ignored)) folders.push_back(entry->path());
  std::ranges::sort(folders);
  if (const auto file = std::ranges::find(info.files, "rig", &SourceFile::role); file != info.files.end())
    if (const auto rig = rig::read_rig(file->content, file->name)) {
      const std::string& ahead = rig::screen_ahead(*rig).name;
      // clang 14 takes no subrange of libstdc++ 12.
      std::stable_partition(folders.begin(), folders.end(),
                            [&](const fs::path& folder) { return folder.filename() == ahead; });
    }
  for (const fs::path& folder : folders)
    if (auto ticks = picture_ticks_in(folder); !ticks.empty()) return {folder, std::move(ticks)};
  return {};
}

std::int64_t nearest(const std::vector<std::int64_t>& ticks, std::int64_t moment) {
  const auto after = std::ranges::lower_bound(ticks, moment);
  if (after == ticks.begin()) return *after;
  const std::int64_t before = *std::prev(after);
  return after == ticks.end() || moment - before <= *after - moment ? before : *after;
}

}  // namespace

std::vector<std::int64_t> picture_ticks_in(const fs::path& folder) {
  std::vector<std::int64_t> ticks;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path name = entry->path().filename();
    const std::string stem = name.stem().string();
    std::int64_t tick = -1;
    const auto [rest, mistake] = std::from_chars(stem.data(), stem.data() + stem.size(), tick);
    if (name.extension() == ".png" && mistake == std::errc() && rest == stem.data() + stem.size() && tick >= 0)
      ticks.push_back(tick);
  }
  std::ranges::sort(ticks);
  return ticks;
}

std::vector<DrivePicture> find_drive_pictures(const SessionInfo& info, std::span<const Event> events,
                                              const fs::path& session_folder, const fs::path& page_folder) {
  std::vector<DrivePicture> pictures;
  std::error_code ignored;
  if (const fs::path file = session_folder / "panorama.png"; fs::is_regular_file(file, ignored))
    pictures.push_back({page_link(file, page_folder), "All screens of one tick, unrolled by angle", true});
  const auto [folder, ticks] = screen_of(info, session_folder);
  if (ticks.empty()) return pictures;
  std::map<std::int64_t, std::string> shown{{ticks.front(), "the first picture"}};
  const auto add = [&](std::int64_t tick, const std::string& why) {
    std::string& says = shown[tick];
    says += (says.empty() ? "" : ", ") + why;
  };
  std::size_t moments = 0;
  for (const Event& event : events) {
    if ((event.kind != "mark" && event.kind != "collision") || moments++ >= most_moments) continue;
    add(nearest(ticks, static_cast<std::int64_t>(event.tick)),
        fmt::format("{} at {:.1f} s", event.kind, event.simulated_time_s));
  }
  if (ticks.size() > 1) add(ticks.back(), "the last picture");
  for (const auto& [tick, why] : shown)
    pictures.push_back({page_link(folder / fmt::format("{}.png", tick), page_folder),
                        fmt::format("{}, {:.1f} s: {}", folder.filename().string(),
                                    static_cast<double>(tick) / info.ticks_per_second, why),
                        false});
  return pictures;
}

std::string picture_section(std::span<const DrivePicture> pictures) {
  using document::escaped;
  if (pictures.empty()) return "";
  const auto figure = [](const DrivePicture& picture) {
    return fmt::format(
        "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\" "
        "loading=\"lazy\"/></a><figcaption>{1}</figcaption></figure>\n",
        escaped(picture.link), escaped(picture.says));
  };
  std::string html = "<h2>Pictures</h2>\n", grid;
  for (const DrivePicture& picture : pictures) (picture.is_wide ? html : grid) += figure(picture);
  return html + (grid.empty() ? "" : "<div class=\"pictures\">\n" + grid + "</div>\n");
}

}  // namespace septet::logging

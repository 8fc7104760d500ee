#include "command-line/command/panorama_file.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <set>
#include <vector>

#include <fmt/core.h>

#include "engine/image/panorama.hpp"
#include "engine/image/png.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

std::set<std::uint64_t> ticks_in(const fs::path& folder) {
  std::set<std::uint64_t> ticks;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().stem().string();
    std::uint64_t tick = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), tick);
    if (error == std::errc() && end == name.data() + name.size() && entry.path().extension() == ".png")
      ticks.insert(tick);
  }
  return ticks;
}

}  // namespace

Expected<void> write_panorama(const fs::path& out, const rig::Rig& rig, const std::string& title) {
  std::set<std::uint64_t> common = ticks_in(out / "screens" / rig.screens.front().name);
  for (const auto& screen : rig.screens) {
    const auto ticks = ticks_in(out / "screens" / screen.name);
    std::set<std::uint64_t> both;
    std::ranges::set_intersection(common, ticks, std::inserter(both, both.end()));
    common = std::move(both);
  }
  if (common.empty())
    return failure("the screens have no picture of a common tick", (out / "screens").string(),
                   "drive for at least one simulated second");
  const std::uint64_t tick = *common.rbegin();

  std::vector<image::Image> pictures;
  pictures.reserve(rig.screens.size());
  image::PanoramaView view;
  view.eye_point_m = rig.eye_point_m;
  view.title = title;
  view.details = {fmt::format("tick {}", tick), fmt::format("{:.2f} s", static_cast<double>(tick) / 120.0)};
  for (const auto& screen : rig.screens) {
    if (screen.only_instruments) continue;
    auto picture = image::read_png(out / "screens" / screen.name / fmt::format("{}.png", tick));
    if (!picture) return tl::unexpected(picture.error());
    pictures.push_back(std::move(*picture));
    const auto& window = screen.views.front().window;
    view.screens.push_back(
        {screen.name, window.lower_left_m, window.lower_right_m, window.upper_left_m, &pictures.back()});
  }
  const auto panorama = image::unroll(view);
  if (!panorama) return tl::unexpected(panorama.error());
  return image::write_png(out / "panorama.png", *panorama);
}

}  // namespace septet::server

#include "logging/report/summary.hpp"

#include <cmath>

#include <fmt/core.h>

#include "logging/report/text_file.hpp"

namespace septet::logging {
namespace {

std::string quoted(const std::string& text) {
  std::string json = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      json += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
      json += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    else
      json += c;
  }
  return json + '"';
}

/// The shortest digits that read back as the same number.
std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

}  // namespace

std::string to_json(const DriveSummary& s) {
  std::string screens;
  for (const ScreenSummary& screen : s.screens) {
    screens += fmt::format(
        "{}\n    {{\"name\": {}, \"frames\": {}, \"frames_off_tick\": {}, \"datagrams_lost\": {}, "
        "\"datagrams_repaired\": {}, \"frame_ms_p50\": {}, \"frame_ms_p99\": {}}}",
        screens.empty() ? "" : ",", quoted(screen.name), screen.frames, screen.frames_off_tick,
        screen.datagrams_lost, screen.datagrams_repaired, number(screen.frame_ms_p50),
        number(screen.frame_ms_p99));
  }
  return fmt::format(
      "{{\n  \"scenario\": {},\n  \"rig\": {},\n  \"seed\": {},\n  \"ticks\": {},\n  "
      "\"simulated_s\": {},\n"
      "  \"wall_s\": {},\n  \"state_hash\": \"{:016x}\",\n  \"lateral_position_m\": {{\"mean\": "
      "{}, \"sd\": {}}},\n"
      "  \"lane_changes\": {},\n  \"screens\": [{}{}]\n}}\n",
      quoted(s.scenario), quoted(s.rig), s.seed, s.ticks, number(s.simulated_s), number(s.wall_s),
      s.state_hash, number(s.lateral_position_mean_m), number(s.lateral_position_sd_m),
      s.lane_changes, screens, s.screens.empty() ? "" : "\n  ");
}

Expected<void> write_summary(const std::filesystem::path& path, const DriveSummary& summary) {
  return write_text_file(path, to_json(summary));
}

}  // namespace septet::logging

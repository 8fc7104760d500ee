#pragma once
/// summary.json: one drive in the figures that a script or a nightly run compares.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::logging {

struct ScreenSummary {
  std::string name;
  std::uint64_t frames = 0;
  std::uint64_t frames_off_tick = 0;  ///< Presented while other screens presented another tick.
  std::uint64_t datagrams_lost = 0;
  std::uint64_t datagrams_repaired = 0;  ///< By the copy in the next datagram.
  double frame_ms_p50 = 0.0, frame_ms_p99 = 0.0;
};

struct DriveSummary {
  std::string scenario, rig;
  std::uint64_t seed = 0;
  std::uint64_t ticks = 0;
  double simulated_s = 0.0;
  double wall_s = 0.0;
  std::uint64_t state_hash = 0;  ///< Of the last tick; sixteen hexadecimal digits in the file.
  double lateral_position_mean_m = 0.0, lateral_position_sd_m = 0.0;
  std::uint64_t lane_changes = 0;
  std::vector<ScreenSummary> screens;
};

/// The JSON text; numbers that are not finite become null.
std::string to_json(const DriveSummary& summary);

Expected<void> write_summary(const std::filesystem::path& path, const DriveSummary& summary);

}  // namespace septet::logging

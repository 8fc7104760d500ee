#pragma once
/// Outcome of a drive, known when it ends: its end, its cost, its screens' reports. Stored in the session file (meta
/// row `outcome`, as JSON), so that summary and report can be made again from the file alone.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/session/drive_end.hpp"

namespace septet::logging {

struct ScreenOutcome {
  std::string name;
  std::uint64_t frames = 0;  ///< Presented, in all its lives.
  /// Presented while other screens presented another tick. This and the following members: of its last life.
  std::uint64_t frames_off_tick = 0;
  std::uint64_t datagrams_lost = 0;
  std::uint64_t datagrams_repaired = 0;  ///< By the copy in the next datagram.
  std::uint64_t refused_ticks = 0;       ///< Received, but unreadable.
  double frame_ms_p50 = 0.0,
         frame_ms_p99 = 0.0;  ///< From picture to picture: drawing, device, display and waiting for others.
  double submit_ms_p50 = 0.0, submit_ms_p99 = 0.0;  ///< Part of that until the picture was handed to the device.
  /// Over all its lives, in real time: from reading the driver's controls to the screen's report that a picture with
  /// them is shown. Empty in lockstep, and if it has shown no picture.
  std::optional<double> report_to_picture_ms_p50, report_to_picture_ms_p99;
  std::vector<double> connected_s, left_s,
      left_behind_s;          ///< In simulated time; more than one `connected_s`: it reconnected.
  bool has_reported = false;  ///< At the end it was connected and sent its report.
};

struct DriveOutcome {
  DriveEnd end = DriveEnd::failed;
  std::string error;  ///< Text of an end by an error.
  std::uint64_t ticks = 0;
  double simulated_s = 0.0, wall_s = 0.0;
  std::uint64_t state_hash = 0;   ///< After the last tick; sixteen hexadecimal digits in the file.
  std::uint64_t inputs_hash = 0;  ///< Hash of all driver inputs (input_hash.hpp): detects alterations.
  std::uint64_t late_ticks = 0;   ///< Real time: ticks begun more than a tick late.
  /// Numbers that were NaN or beyond all bounds and were reset; the events name participant and time.
  std::uint64_t bad_numbers = 0;
  std::uint64_t lost_records = 0;  ///< Missing from the log.
  double log_waited_s = 0.0;       ///< Time that the drive waited for the log's disk.
  std::vector<ScreenOutcome> screens;
};

std::string to_json(const DriveOutcome& outcome);
/// `where` is the session, for error messages.
Expected<DriveOutcome> read_outcome(const std::string& json, const std::string& where);

}  // namespace septet::logging

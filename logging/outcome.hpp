#pragma once
/// What became of a drive, known when it ends: how it ended, what it cost, what its screens have seen. It lies in the session
/// file (meta row `outcome`, as JSON), so that summary and report can be made again from the file alone.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/drive_end.hpp"

namespace septet::logging {

struct ScreenOutcome {
  std::string name;
  std::uint64_t frames = 0;  ///< That it presented, in all its lives.
  std::uint64_t frames_off_tick =
      0;  ///< Presented while other screens presented another tick. This and what follows: of its last life.
  std::uint64_t datagrams_lost = 0;
  std::uint64_t datagrams_repaired = 0;  ///< By the copy in the next datagram.
  std::uint64_t refused_ticks = 0;       ///< That arrived and could not be read.
  double frame_ms_p50 = 0.0,
         frame_ms_p99 = 0.0;  ///< From picture to picture: drawing, device, display and waiting for others.
  double submit_ms_p50 = 0.0, submit_ms_p99 = 0.0;  ///< Of that, until the picture was handed to the device.
  /// Of all its lives, in real time: from reading the driver's controls to the screen's word that a picture with them is shown. Nothing
  /// in lockstep, and where it has shown none.
  std::optional<double> report_to_picture_ms_p50, report_to_picture_ms_p99;
  std::vector<double> connected_s, left_s,
      left_behind_s;          ///< When, in simulated time; more than one `connected_s`: it came back.
  bool has_reported = false;  ///< At the end it was there and said what it had seen.
};

struct DriveOutcome {
  DriveEnd end = DriveEnd::failed;
  std::string error;  ///< Where the end is one.
  std::uint64_t ticks = 0;
  double simulated_s = 0.0, wall_s = 0.0;
  std::uint64_t state_hash = 0;   ///< Of the last tick; sixteen hexadecimal digits in the file.
  std::uint64_t inputs_hash = 0;  ///< Of all driver inputs (input_hash.hpp): tells whether they have been altered.
  std::uint64_t late_ticks = 0;   ///< Real time: that began more than a tick late.
  std::uint64_t bad_numbers =
      0;  ///< That were none (0/0, beyond all bounds) and were reset; the events say whose and when.
  std::uint64_t lost_records = 0;  ///< That the log lacks.
  double log_waited_s = 0.0;       ///< For how long the drive waited for the log's disk.
  std::vector<ScreenOutcome> screens;
};

std::string to_json(const DriveOutcome& outcome);
/// `where` is the session, for who reads of a fault.
Expected<DriveOutcome> read_outcome(const std::string& json, const std::string& where);

}  // namespace septet::logging

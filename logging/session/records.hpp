#pragma once
/// Content of a session file, as plain data: FORMAT.md has the meaning of every field.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/world/driver_input.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::logging {

/// A text that the drive was built from.
struct SourceFile {
  std::string role;  ///< "rig", "scenario", "road", "vehicle", …
  std::string name;
  std::string content;
  bool operator==(const SourceFile&) const = default;
};

/// Facts known when a drive begins.
struct SessionInfo {
  std::string septet_version;
  std::string git_revision;  ///< Empty if unknown.
  std::string started_utc;   ///< ISO 8601, from the caller's clock.
  std::string participant;   ///< The driver's code.
  double ticks_per_second = 120.0;
  std::map<std::string, std::uint64_t> seeds;
  std::map<std::string, std::string> parameters;  ///< Scenario parameters given from outside.
  std::map<std::string, std::string> other;       ///< Any other meta rows.
  std::vector<SourceFile> files;
  bool operator==(const SessionInfo&) const = default;
};

/// Input of one tick.
struct InputRecord {
  Tick tick = 0;
  std::optional<Bytes> report;  ///< The HID report as read, id first; empty for a keyboard.
  DriverInput input;
  bool operator==(const InputRecord&) const = default;
};

struct SceneEdit {
  Tick tick = 0;
  Bytes command;
  bool operator==(const SceneEdit&) const = default;
};

/// Whole state of the simulation after a tick, opaque here (engine/simulation/saved_state.hpp).
struct StateRecord {
  Tick tick = 0;
  Bytes data;
  bool operator==(const StateRecord&) const = default;
};

/// Commands to fan, shaker and wheel force, as shares of their maximum; steering is positive to the left.
struct ActuatorRecord {
  Tick tick = 0;
  double fan = 0.0, vibration = 0.0, vibration_hz = 0.0, steering = 0.0;
  bool is_cut = false;  ///< A fault or the emergency stop held them at 0, or released them.
  bool operator==(const ActuatorRecord&) const = default;
};

/// The vehicle ahead in the driver's lane.
struct Leader {
  ParticipantId participant = 0;
  double distance_gap_m = 0.0;      ///< The driver's front bumper to its rear bumper, along the lane.
  double distance_headway_m = 0.0;  ///< Front bumper to front bumper, along the lane.
  double speed_mps = 0.0;
  bool operator==(const Leader&) const = default;
};

/// One row of the 10 Hz table.
struct Sample {
  Tick tick = 0;
  double simulated_time_s = 0.0;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0, heading_rad = 0.0;
  double speed_mps = 0.0;
  double longitudinal_acceleration_mps2 = 0.0, lateral_acceleration_mps2 = 0.0;
  double yaw_rate_radps = 0.0;
  std::uint32_t road = 0;
  std::int32_t lane = 0;
  double road_s_m = 0.0, lateral_position_m = 0.0, lane_width_m = 0.0;
  std::optional<Leader> leader;
  double steering_wheel_rad = 0.0, accelerator = 0.0, brake = 0.0, clutch = 0.0;
  std::int32_t gear = 0;
  Lamps lamps;
  double gaze_heading_rad = 0.0;
  bool operator==(const Sample&) const = default;
};

struct Event {
  Tick tick = 0;
  double simulated_time_s = 0.0;
  std::string kind;  ///< "lane_change", "mirror_glance", "collision", "scenario", …
  std::optional<ParticipantId> participant;
  std::string detail;  ///< key=value pairs.
  bool operator==(const Event&) const = default;
};

/// Kind of the events that are input: an operator's change during the drive, applied before the event's tick.
inline constexpr std::string_view operator_command_kind = "operator_command";
/// True for the command that moved the driver's car elsewhere.
inline bool is_put(const Event& event) {
  return event.kind == operator_command_kind && event.detail.starts_with("put ");
}

struct QuestionnaireRecord {
  std::string item;      ///< Short name of the question or endpoint: "fun", "drive_completed".
  std::string question;  ///< Wording of the question.
  std::optional<std::string> answer;
  std::optional<double> value;  ///< On the item's scale.
  double observed_s = 0.0;      ///< Simulated time until which the participant was observed.
  bool censored = false;        ///< The participant stopped before an answer or the endpoint.
  std::string reason;           ///< For stopping, in their words.
  bool operator==(const QuestionnaireRecord&) const = default;
};

/// The sample of the driver's car in this snapshot.
Sample take_sample(const Snapshot& snapshot, const std::optional<Leader>& leader);

/// True if this tick is one of the ten of its second; true for tick 0.
bool is_sample_due(Tick tick, double ticks_per_second);

}  // namespace septet::logging

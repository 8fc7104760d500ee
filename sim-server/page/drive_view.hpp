#pragma once
/// What the operator's page shows of a drive, as plain data: what holds for all of it, and how it stands.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/world/taken_snapshot.hpp"

namespace septet::page {

/// A condition that can be set, as the page's slider has it.
struct Adjustable {
  std::string name;  ///< Unit in the name: "rain_mm_per_h".
  double least = 0.0, most = 1.0;
};

/// What does not change during the drive.
struct DriveFacts {
  std::string scenario, rig, vehicle, participant;
  std::uint64_t seed = 0;
  double tick_rate_hz = 120.0;
  double planned_s = 0.0;  ///< Simulated; 0: until somebody ends it.
  std::vector<Adjustable> conditions;
  bool has_traffic = false;  ///< Its density can be changed.
  ParticipantId driver = 0;
};

struct ScreenView {
  std::string name;
  bool live = false;
  std::uint64_t frames = 0;
  double frame_ms = 0.0;             ///< From picture to picture, of the newest.
  std::optional<Tick> presented;     ///< The newest tick that it has shown.
  std::uint64_t lost_baselines = 0;  ///< Ticks that came and could not be read, for what came before was lost.
  std::size_t drop_outs = 0;         ///< How often it has gone.
};

struct LeaderView {
  ParticipantId participant = 0;
  double gap_m = 0.0;
  double speed_mps = 0.0;
};

/// How the drive stands.
struct DriveView {
  std::shared_ptr<const TakenSnapshot> newest;  ///< Null before the first tick.
  std::string phase;                            ///< "driving", "paused", "waiting for ahead".
  bool is_paused = false;
  double wall_s = 0.0;            ///< Of any clock that goes on.
  double real_time_factor = 0.0;  ///< Simulated seconds a second, of late.
  bool has_actuators = false;
  std::optional<std::string> actuators_cut;  ///< Why fan, shaker and wheel force are at 0; nothing while they run.
  std::string alarm;                         ///< What the driver reads: an emergency stop.
  std::optional<LeaderView> leader;
  std::vector<ScreenView> screens;
  std::vector<double> conditions;     ///< As DriveFacts::conditions.
  std::vector<std::string> triggers;  ///< Acts and events that have not begun.
};

}  // namespace septet::page

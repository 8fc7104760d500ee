#pragma once
/// What the operator's page shows of a drive, as plain data: what holds for all of it, and how it stands.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/world/taken_snapshot.hpp"

namespace septet::page {

/// A condition that can be set, as the page's slider has it.
struct Adjustable {
  std::string name;  ///< Unit in the name: "rain_mm_per_h".
  double least = 0.0, most = 1.0;
};

/// How the driver feels is asked for each minute: one item of a questionnaire.
struct RatingScale {
  std::string title, text;
  int least = 0;
  std::vector<std::string> labels;  ///< From least on.
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
  std::optional<RatingScale> rating;
  std::vector<std::string> things;  ///< That can be placed on the road.
};

struct ScreenView {
  std::string name;
  bool live = false;
  std::uint64_t frames = 0;
  double frame_ms = 0.0;             ///< From picture to picture, of the newest.
  std::optional<Tick> presented;     ///< The newest tick that it has shown.
  std::uint64_t lost_baselines = 0;  ///< Ticks that came and could not be read, for what came before was lost.
  std::size_t drop_outs = 0;         ///< How often it has gone.
  std::shared_ptr<const std::string>
      thumbnail;  ///< What it shows, a PNG of any bytes; another one each time. May be null.
};

struct LeaderView {
  ParticipantId participant = 0;
  double gap_m = 0.0;
  double speed_mps = 0.0;
};

/// Of the minute of driven time that goes on, the first being 0.
struct RatingView {
  int minute = 0;
  std::optional<int> value;  ///< Its answer, if it has one.
};

/// Stands or lies on the road, and may be taken away.
struct ThingView {
  std::uint32_t id = 0;
  std::string name;
  double x_m = 0.0, y_m = 0.0;  ///< World.
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
  std::vector<double> conditions;  ///< As DriveFacts::conditions.
  RatingView rating;
  std::vector<std::pair<std::string, bool>>
      entities;  ///< Of the scenario, who may be hidden, and whether they are there.
  std::vector<ThingView> lying;
  std::vector<std::string> triggers;  ///< Acts and events that have not begun.
};

}  // namespace septet::page

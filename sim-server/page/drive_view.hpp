#pragma once
/// Content of the operator's page for a drive, as plain data: constants, and the present state.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/world/taken_snapshot.hpp"
#include "sim-server/page/placing_view.hpp"

namespace septet::page {

/// An adjustable condition, as the page's slider shows it.
struct Adjustable {
  std::string name;  ///< Unit in the name: "rain_mm_per_h".
  double least = 0.0, most = 1.0;
};

/// Question of each minute on the driver's well-being: one item of a questionnaire.
struct RatingScale {
  std::string title, text;
  int least = 0;
  std::vector<std::string> labels;  ///< From least on.
};

/// A lesson's task, from its file.
struct LessonTaskFacts {
  std::string says;           ///< The sentence that the learner reads.
  std::string measure, unit;  ///< "gap", "s".
  double bound = 0.0;
  bool is_at_most = false;  ///< True if larger values are worse.
};
struct LessonFacts {
  std::string title, aim;
  double pass_mark = 6.0, shortest_s = 0.0;
  std::vector<LessonTaskFacts> tasks;
};

/// Simulated times at which the drive keeps its state.
struct KeptStates {
  double from_s = 0.0, every_s = 10.0;
};

/// Constants of the drive.
struct DriveFacts {
  std::string scenario, rig, vehicle, participant;
  std::uint64_t seed = 0;
  double tick_rate_hz = 120.0;
  double planned_s = 0.0;  ///< Simulated; 0: until a person ends it.
  std::vector<Adjustable> conditions;
  bool has_traffic = false;  ///< Its density can be changed.
  ParticipantId driver = 0;
  std::optional<RatingScale> rating;
  std::vector<std::string> things;        ///< Things that can be placed on the road.
  std::vector<std::string> faults;        ///< Parts of the car that can fail.
  bool speaks = false;                    ///< Words to the student can be spoken aloud.
  std::optional<KeptStates> kept_states;  ///< Empty: the drive cannot begin again at one.
  std::optional<LessonFacts> lesson;      ///< If the drive is a lesson.
  PlacingFacts placing;
};

/// State of a task.
struct LessonTaskView {
  std::optional<double> mark;  ///< Out of 10; empty: no occasion.
  std::string severity;        ///< "none", "minor", "serious", "dangerous": of the worst fault.
  std::size_t faults = 0;
};
/// An interval in which a task was beyond its bound; it may be going on.
struct LessonFaultView {
  std::uint32_t number = 0;  ///< Within this drive; constant while the fault is reported.
  std::size_t task = 0;
  double from_s = 0.0, to_s = 0.0, worst = 0.0;
  std::string at;  ///< Place, in words; may be empty.
  std::string severity;
  std::shared_ptr<const std::string> still;  ///< Picture of the screen ahead at that time, any bytes; may be null.
};
/// Marks so far, one for each task; and the faults, by their beginning.
struct LessonView {
  std::vector<LessonTaskView> tasks;
  std::optional<double> mark;
  bool passed = false;
  std::vector<LessonFaultView> faults;
};

/// An event of the drive.
struct PageEvent {
  double simulated_s = 0.0;
  std::string kind;  ///< Kind as in the log: "collision", "mark"; "message": the text is complete.
  std::vector<std::pair<std::string, std::string>> values;  ///< By name; a part without a name is called "what".
  std::string text;                                         ///< The same in English words.
};

struct ScreenView {
  std::string name;
  bool live = false;
  std::uint64_t frames = 0;
  double frame_ms = 0.0;             ///< From picture to picture, of the newest.
  std::optional<Tick> presented;     ///< The newest tick that it has shown.
  std::uint64_t lost_baselines = 0;  ///< Ticks that arrived and could not be decoded, for lack of an earlier one.
  std::size_t drop_outs = 0;         ///< Number of disconnections.
  /// Picture of the screen, any bytes; a new object each time. May be null.
  std::shared_ptr<const std::string> thumbnail;
  std::shared_ptr<const std::string> large_picture;  ///< The same, large, while an operator watches it. May be null.
};

struct LeaderView {
  ParticipantId participant = 0;
  double gap_m = 0.0;
  double speed_mps = 0.0;
};

/// For the current minute of driven time, the first being 0.
struct RatingView {
  int minute = 0;
  std::optional<int> value;  ///< Its answer, if it has one.
};

/// A thing that stands or lies on the road, and can be removed.
struct ThingView {
  std::uint32_t id = 0;
  std::string name;
  double x_m = 0.0, y_m = 0.0;  ///< World.
};

/// State of the drive.
struct DriveView {
  std::shared_ptr<const TakenSnapshot> newest;  ///< Null before the first tick.
  std::string phase;                            ///< "driving", "paused", "waiting for ahead".
  bool is_paused = false;
  double wall_s = 0.0;            ///< Time of any clock that goes on.
  double real_time_factor = 0.0;  ///< Simulated seconds per second, recently.
  bool has_actuators = false;
  std::optional<std::string> fault;  ///< Stopped device, which cuts the actuators if there are any; empty: all run.
  std::string alarm;                 ///< Text that the driver reads: an emergency stop.
  std::optional<LeaderView> leader;
  std::vector<ScreenView> screens;
  std::vector<double> conditions;  ///< Values in the order of DriveFacts::conditions.
  RatingView rating;
  /// The scenario's entities that can be hidden, and their presence.
  std::vector<std::pair<std::string, bool>> entities;
  std::vector<ThingView> lying;
  std::vector<std::string> triggers;  ///< Acts and events that have not begun.
  std::vector<std::string> hazards;   ///< Hazards of the scenario that may be set on the map now.
  bool instructor_brakes = false;
  std::vector<bool> faults;                  ///< States in the order of DriveFacts::faults: true if it has failed.
  std::shared_ptr<const LessonView> lesson;  ///< A new object whenever it changes; null: no lesson, or no marks.
  std::shared_ptr<const PlacedView> placed;  ///< A new object whenever it changes; null: the drive has no scene.
};

}  // namespace septet::page

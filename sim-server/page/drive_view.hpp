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

/// A lesson's task, as its file has it.
struct LessonTaskFacts {
  std::string says;           ///< The sentence that the learner reads.
  std::string measure, unit;  ///< "gap", "s".
  double bound = 0.0;
  bool is_at_most = false;  ///< More of it is worse.
};
struct LessonFacts {
  std::string title, aim;
  double pass_mark = 6.0, shortest_s = 0.0;
  std::vector<LessonTaskFacts> tasks;
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
  std::vector<std::string> things;    ///< That can be placed on the road.
  std::vector<std::string> faults;    ///< What of the car can fail.
  bool speaks = false;                ///< A word to the student can be heard.
  std::optional<LessonFacts> lesson;  ///< Where the drive is one.
};

/// How a task stands.
struct LessonTaskView {
  std::optional<double> mark;  ///< Of 10; nothing: there was no occasion.
  std::string severity;        ///< "none", "minor", "serious", "dangerous": of the worst.
  std::size_t faults = 0;
};
/// A task was beyond its bound for a time, which may go on.
struct LessonFaultView {
  std::uint32_t number = 0;  ///< Of this drive's; the same as long as the fault is told.
  std::size_t task = 0;
  double from_s = 0.0, to_s = 0.0, worst = 0.0;
  std::string at;  ///< Where, in words; may be empty.
  std::string severity;
  std::shared_ptr<const std::string>
      still;  ///< What the screen ahead showed then, a picture of any bytes; may be null.
};
/// Of the marks so far, one for each task; and the faults, as they began.
struct LessonView {
  std::vector<LessonTaskView> tasks;
  std::optional<double> mark;
  bool passed = false;
  std::vector<LessonFaultView> faults;
};

/// Something that has happened.
struct PageEvent {
  double simulated_s = 0.0;
  std::string kind;  ///< Of the log: "collision", "mark"; "message": the text says it all.
  std::vector<std::pair<std::string, std::string>> values;  ///< By name; what has no name is called "what".
  std::string text;                                         ///< The same in English words.
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
      thumbnail;  ///< What it shows, a picture of any bytes; another one each time. May be null.
  std::shared_ptr<const std::string> large_picture;  ///< The same, large, while somebody watches it. May be null.
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
  std::optional<std::string>
      fault;          ///< What has stopped, and cuts the actuators where there are any; nothing: all run.
  std::string alarm;  ///< What the driver reads: an emergency stop.
  std::optional<LeaderView> leader;
  std::vector<ScreenView> screens;
  std::vector<double> conditions;  ///< As DriveFacts::conditions.
  RatingView rating;
  std::vector<std::pair<std::string, bool>>
      entities;  ///< Of the scenario, who may be hidden, and whether they are there.
  std::vector<ThingView> lying;
  std::vector<std::string> triggers;  ///< Acts and events that have not begun.
  bool instructor_brakes = false;
  std::vector<bool> faults;  ///< As DriveFacts::faults: whether it has failed.
  std::shared_ptr<const LessonView>
      lesson;  ///< Another one whenever it changes; null: it is none, or nothing is marked.
};

}  // namespace septet::page

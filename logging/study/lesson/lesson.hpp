#pragma once
/// A lesson: the tasks marked in a drive, from a file beside its scenario (NAME.lesson.toml), and the marks.
///
/// Each task has a measure over the drive's samples and events, a bound, and a tolerance: 10 within the bound, 0 at
/// bound and tolerance, linear in between. A task without an occasion in the drive has no mark. The worst moment of
/// each task is kept, for the debrief. Pure functions of records. Definitions and sources: docs/lessons.md.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

enum class LessonMeasure {
  speed,  ///< Highest speed, km/h; at most the bound.
  gap,    ///< Shortest time gap to the leader, s, at 5 m/s or more; at least the bound.
  /// Largest distance from the middle of the lane, m, without 4 s on either side of lane changes; at most the bound.
  position,
  /// Per lane change: time for which the indicator had been on when the car began to move aside, s; at least the bound.
  indicator,
  mirror,     ///< Per lane change: time since the last glance at a mirror began, s; at most the bound.
  lookout,    ///< Longest time without a glance at a mirror, s, at 5 m/s or more; at most the bound.
  stop,       ///< Distance to the leader at the car's first halt, m; at least the bound.
  hazard,     ///< Time from the first halt to the hazard lights, s; at most the bound.
  collision,  ///< Number of bodies touched; at most the bound. Each is dangerous.
  /// Per yield line: time left until the one with right of way would have been there, s; at least the bound.
  yielding,
  turn,     ///< Per turn at a fork: time for which the indicator had been on at its beginning, s; at least the bound.
  limit,    ///< Largest excess over the posted limit, km/h; at most the bound.
  braking,  ///< Hardest braking over half a second, m/s², at 2 m/s or more; at most the bound.
  /// Per hazard (hazard_reactions.hpp): time from when it could be seen to the driver's reaction, s; at most the bound.
  perception,
};

struct LessonTask {
  std::string id, says;  ///< One word, and the sentence for the learner.
  LessonMeasure measure = LessonMeasure::speed;
  double bound = 0.0, tolerance = 1.0, weight = 1.0;
  double from_s = 0.0, to_s = 1e9;  ///< Simulated time in which it is marked.
};

struct Lesson {
  std::string title, aim;
  double pass_mark = 6.0;   ///< Least weighted mean to pass, without a dangerous fault.
  double shortest_s = 0.0;  ///< A shorter drive does not count as taken, and gets no mark.
  std::vector<LessonTask> tasks;
};

/// Role of its text among a session's files.
inline constexpr std::string_view lesson_role = "lesson";

/// Error: the first mistake in it, with its line.
Expected<Lesson> read_lesson(std::string_view text, std::string_view name);

enum class Severity { none, minor, serious, dangerous };
std::string_view name_of(Severity severity);

struct TaskMark {
  std::optional<double> mark;  ///< 0 to 10; empty: no occasion.
  Severity severity = Severity::none;
  std::size_t occasions = 0, faults = 0;  ///< Number of occasions, and of those beyond the bound.
  double worst = 0.0;                     ///< In the measure's unit…
  double worst_s = 0.0;                   ///< …and its time.
  std::string worst_at;                   ///< Place, in words; empty for measures without one.
};

struct LessonMarks {
  std::vector<TaskMark> tasks;  ///< In the order of Lesson::tasks.
  std::optional<double> mark;   ///< Weighted mean of the tasks with a mark; empty for a lesson that was not taken.
  bool taken = false;           ///< The drive was long enough.
  bool passed = false;
  bool head_is_known = false;  ///< If false, tasks of glances have no mark.
};

/// "passed", "not passed", or "too short to be marked".
std::string_view outcome_of(const LessonMarks& marks);

/// Head direction counts as measured if it ever moved: if not, glances are not marked.
LessonMarks mark_lesson(const Lesson& lesson, std::span<const Sample> samples, std::span<const Event> events);

/// An interval in which a task was beyond its bound: one occasion, or samples less than two seconds apart.
struct LessonFault {
  std::size_t task = 0;             ///< Index into Lesson::tasks.
  double from_s = 0.0, to_s = 0.0;  ///< Simulated; first and last moment.
  double worst = 0.0;               ///< In the measure's unit…
  double worst_s = 0.0;             ///< …and its time.
  std::string worst_at;             ///< Place, in words; empty for measures without one.
  Severity severity = Severity::minor;
};

/// All faults, by their beginning. Samples of half a drive give the faults of that half, except that those of the last
/// `settles_s` may still be withdrawn.
std::vector<LessonFault> find_faults(const Lesson& lesson, std::span<const Sample> samples,
                                     std::span<const Event> events);
/// Time after which later samples cannot withdraw a fault: lane position is excused by the lane change that it was part
/// of.
double settles_s(LessonMeasure measure);

/// One word, as in a lesson's file: "gap".
std::string_view name_of(LessonMeasure measure);

/// True if larger values are worse.
bool is_at_most(LessonMeasure measure);
/// True for measures of glances, which are known only where the head's direction is.
bool is_of_glances(LessonMeasure measure);
/// True if every sample is an occasion.
bool is_of_each_sample(LessonMeasure measure);
/// Unit of a measure: "km/h", "s", "m", "m/s²", "".
std::string_view unit_of(LessonMeasure measure);

}  // namespace septet::logging

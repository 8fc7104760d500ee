#pragma once
/// A lesson: what is marked of a drive, told by a file beside its scenario (NAME.lesson.toml), and the marks.
///
/// Each task has a measure over the drive's samples and events, a bound, and a tolerance: 10 within the bound, 0 at bound and tolerance, even
/// in between. What a drive never gave occasion to is not seen, which is no mark. The worst moment of each task is kept, for the debrief.
/// Pure functions of records. What is marked and how: docs/lessons.md; the sources are there.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/records.hpp"

namespace septet::logging {

enum class LessonMeasure {
  speed,  ///< The fastest, km/h; at most the bound.
  gap,    ///< The shortest time gap to who is ahead, s, at 5 m/s or more; at least the bound.
  position,  ///< The farthest from the middle of the lane, m, without 4 s on either side of lane changes; at most the bound.
  indicator,  ///< Per lane change: for how long the indicator had been on when the car began to move aside, s; at least the bound.
  mirror,     ///< Per lane change: how long ago the last glance at a mirror began, s; at most the bound.
  lookout,    ///< The longest time without a glance at a mirror, s, at 5 m/s or more; at most the bound.
  stop,       ///< How far behind who is ahead the car stood, m, at its first halt; at least the bound.
  hazard,     ///< From the first halt to the hazard lights, s; at most the bound.
  collision,  ///< How many were touched; at most the bound. Any is dangerous.
  yielding,  ///< Per line where others had right of way: the time that was left until they would have been there, s; at least the bound.
  turn,      ///< Per turn at a fork: for how long the indicator had been on when it began, s; at least the bound.
  limit,     ///< The most over the posted limit, km/h; at most the bound.
  braking,   ///< The hardest braking of half a second, m/s², as far as 2 m/s; at most the bound.
};

struct LessonTask {
  std::string id, says;  ///< One word, and the sentence that the learner reads.
  LessonMeasure measure = LessonMeasure::speed;
  double bound = 0.0, tolerance = 1.0, weight = 1.0;
  double from_s = 0.0, to_s = 1e9;  ///< Simulated time in which it is marked.
};

struct Lesson {
  std::string title, aim;
  double pass_mark = 6.0;   ///< Of the weighted mean, where nothing was dangerous.
  double shortest_s = 0.0;  ///< Whoever drove for less has not taken it, and gets no mark.
  std::vector<LessonTask> tasks;
};

/// The role of its text among a session's files.
inline constexpr std::string_view lesson_role = "lesson";

/// Error: the first mistake in it, with its line.
Expected<Lesson> read_lesson(std::string_view text, std::string_view name);

enum class Severity { none, minor, serious, dangerous };
std::string_view name_of(Severity severity);

struct TaskMark {
  std::optional<double> mark;  ///< 0 to 10; nothing: not seen.
  Severity severity = Severity::none;
  std::size_t occasions = 0, faults = 0;  ///< How often it could be marked, and how often it was beyond the bound.
  double worst = 0.0;                     ///< In the measure's unit…
  double worst_s = 0.0;                   ///< …and when that was.
  std::string worst_at;                   ///< Where, in words; empty where the measure does not tell.
};

struct LessonMarks {
  std::vector<TaskMark> tasks;  ///< As Lesson::tasks.
  std::optional<double> mark;   ///< Weighted mean of what was seen; none of a lesson that was not taken.
  bool taken = false;           ///< It was driven for long enough.
  bool passed = false;
  bool head_is_known = false;  ///< Else no task of glances could be marked, whatever was driven.
};

/// "passed", "not passed", or "too short to be marked".
std::string_view outcome_of(const LessonMarks& marks);

/// Whether the head's direction was measured is told by whether it ever moved: where it did not, glances are not marked.
LessonMarks mark_lesson(const Lesson& lesson, std::span<const Sample> samples, std::span<const Event> events);

/// A time during which a task was beyond its bound: an occasion of its own, or samples without two seconds between them.
struct LessonFault {
  std::size_t task = 0;             ///< Of Lesson::tasks.
  double from_s = 0.0, to_s = 0.0;  ///< Simulated; of its first and last moment.
  double worst = 0.0;               ///< In the measure's unit…
  double worst_s = 0.0;             ///< …and when that was.
  std::string worst_at;             ///< Where, in words; empty where the measure does not tell.
  Severity severity = Severity::minor;
};

/// All of them, in the order in which they begin. Samples of half a drive give those of that half, except that what is told of the last
/// `settles_s` may still be taken back.
std::vector<LessonFault> find_faults(const Lesson& lesson, std::span<const Sample> samples,
                                     std::span<const Event> events);
/// For how long what comes after can still excuse it: where one drives in the lane, by the change of lanes that it was a part of.
double settles_s(LessonMeasure measure);

/// In one word, as a lesson's file has it: "gap".
std::string_view name_of(LessonMeasure measure);

/// Whether more of it is worse.
bool is_at_most(LessonMeasure measure);
/// Whether it looks at glances, which are known only where the head's direction is.
bool is_of_glances(LessonMeasure measure);
/// Whether every sample is an occasion.
bool is_of_each_sample(LessonMeasure measure);
/// What a measure is told in: "km/h", "s", "m", "m/s²", "".
std::string_view unit_of(LessonMeasure measure);

}  // namespace septet::logging

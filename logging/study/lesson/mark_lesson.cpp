#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/math/speed_units.hpp"
#include "logging/study/lesson/lesson.hpp"
#include "logging/study/measures/crashes.hpp"
#include "logging/study/measures/glances.hpp"
#include "logging/study/measures/hazard_reactions.hpp"
#include "logging/study/measures/lane_changes.hpp"
#include "logging/study/measures/sample_steps.hpp"

namespace septet::logging {
namespace {

constexpr double driving_mps = 5.0, standing_mps = 0.1;
constexpr double braking_from_mps = 2.0;  ///< Below it a car nods as it comes to stand.
constexpr double braking_s = 0.5 - 1e-6;  ///< Sums of 0.1 s steps fall short by rounding.
constexpr double aside_mps = 0.2;         ///< Slower is keeping the lane.
constexpr double around_change_s = 4.0;   ///< A lane is left and entered within this on either side of the crossing.
constexpr double blink_s = 0.8;           ///< UN R48 asks for 60 flashes a minute at least: dark for half a second.

/// One occasion: its value and its time.
struct Moment {
  double time_s = 0.0, value = 0.0;
  std::string at = {};  ///< Place, in words.
};

/// Input of all tasks.
struct DriveSeen {
  std::span<const Sample> samples;
  std::span<const Event> events;
  std::vector<LaneChange> changes;
  std::vector<Glance> glances;
  bool head_is_known = false;
  std::vector<double> put_s = {};                            ///< Times at which an instructor put the car elsewhere.
  std::vector<std::pair<double, double>> instructor_s = {};  ///< Intervals of the instructor's braking.
};

/// True if the car was moved by an operator between two times: such a change was not driven.
bool is_put_between(const DriveSeen& drive, double from_s, double to_s) {
  return std::ranges::any_of(drive.put_s, [&](double at_s) { return at_s >= from_s - 1e-6 && at_s < to_s; });
}

template <class Value>
std::vector<Moment> each_sample(const DriveSeen& drive, const Value& value) {
  std::vector<Moment> moments;
  for (const Sample& sample : drive.samples)
    if (const std::optional<double> found = value(sample); found && std::isfinite(*found))
      moments.push_back({sample.simulated_time_s, *found});
  return moments;
}

/// Time for which a lamp had been blinking.
double blinked_s(const DriveSeen& drive, Lamp lamp, double time_s) {
  double first_lit_s = time_s;
  auto at = std::ranges::upper_bound(drive.samples, time_s, {}, &Sample::simulated_time_s);
  while (at != drive.samples.begin()) {
    --at;
    if (first_lit_s - at->simulated_time_s > blink_s) break;
    if (at->lamps.has(lamp)) first_lit_s = at->simulated_time_s;
  }
  return time_s - first_lit_s;
}

/// Time at which the car began to move towards the line that it crossed: it has moved there at `aside_mps` or more
/// since.
double began_to_move_s(const DriveSeen& drive, const LaneChange& change) {
  auto at = std::ranges::lower_bound(drive.samples, change.simulated_time_s, {}, &Sample::simulated_time_s);
  if (at != drive.samples.begin()) --at;  // The last sample in the lane that is left.
  const double to_left = change.lanes_to_left > 0 ? 1.0 : -1.0;
  for (; at != drive.samples.begin(); --at) {
    const Sample &now = *at, &before = *std::prev(at);
    const double step_s = now.simulated_time_s - before.simulated_time_s;
    if (now.lane != before.lane || is_gap(before, now)) break;
    if (to_left * (now.lateral_position_m - before.lateral_position_m) < aside_mps * step_s) break;
  }
  return at == drive.samples.end() ? change.simulated_time_s : std::min(at->simulated_time_s, change.simulated_time_s);
}

/// Time for which the lamp of the change's side had been blinking when the car began to move.
std::vector<Moment> indicators(const DriveSeen& drive) {
  std::vector<Moment> moments;
  for (const LaneChange& change : drive.changes) {
    const Lamp lamp = change.lanes_to_left > 0 ? Lamp::indicator_left : Lamp::indicator_right;
    const double began_s = began_to_move_s(drive, change);
    moments.push_back({began_s, blinked_s(drive, lamp, began_s)});
  }
  return moments;
}

/// Value of "name=" in an event's detail; empty if missing.
std::string_view word_of(const Event& event, std::string_view name) {
  const std::string_view detail = event.detail;
  for (std::size_t at = 0; at < detail.size();) {
    const std::size_t end = std::min(detail.find(' ', at), detail.size());
    const std::string_view pair = detail.substr(at, end - at);
    if (pair.starts_with(name) && pair.size() > name.size() && pair[name.size()] == '=')
      return pair.substr(name.size() + 1);
    at = end + 1;
  }
  return {};
}

std::optional<double> number_of(const Event& event, std::string_view name) {
  const std::string_view word = word_of(event, name);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<Moment> yieldings(const DriveSeen& drive) {
  std::vector<Moment> moments;
  for (const Event& event : drive.events) {
    const auto margin_s = number_of(event, "margin_s");
    if (event.kind != "right_of_way" || !margin_s) continue;
    const std::string_view kind = word_of(event, "kind");
    moments.push_back({event.simulated_time_s, *margin_s,
                       kind == "lights"     ? fmt::format("at the lights, which showed {}", word_of(event, "shows"))
                       : kind == "crossing" ? std::string("at the crossing, to somebody on foot")
                                            : std::string("at the give-way line, to who came there")});
  }
  return moments;
}

std::vector<Moment> turns(const DriveSeen& drive) {
  std::vector<Moment> moments;
  for (const Event& event : drive.events) {
    const auto began_s = number_of(event, "began_s");
    if (event.kind != "turn" || !began_s) continue;
    const bool left = word_of(event, "side") == "left";
    moments.push_back({*began_s, blinked_s(drive, left ? Lamp::indicator_left : Lamp::indicator_right, *began_s),
                       left ? "turning to the left" : "turning to the right"});
  }
  return moments;
}

/// Samples without a posted or known limit do not count.
std::vector<Moment> limits(const DriveSeen& drive) {
  std::vector<Moment> moments;
  auto event = drive.events.begin();
  double limit_kmh = 0.0;
  for (const Sample& sample : drive.samples) {
    const auto is_past = [&](const Event& next) {
      return next.kind != "speed_limit" || next.simulated_time_s <= sample.simulated_time_s;
    };
    for (; event != drive.events.end() && is_past(*event); ++event)
      if (event->kind == "speed_limit") limit_kmh = number_of(*event, "kmh").value_or(0.0);
    if (limit_kmh > 0.0)
      moments.push_back({sample.simulated_time_s, std::max(0.0, 3.6 * std::abs(sample.speed_mps) - limit_kmh),
                         fmt::format("where {:.0f} km/h are allowed", limit_kmh)});
  }
  return moments;
}

/// From speeds: a momentary pitch of the car's body is no braking.
std::vector<Moment> brakings(const DriveSeen& drive) {
  std::vector<Moment> moments;
  std::size_t from = 0;
  for (std::size_t i = 0; i < drive.samples.size(); ++i) {
    const Sample& now = drive.samples[i];
    if (i > 0 && (is_gap(drive.samples[i - 1], now) ||
                  is_put_between(drive, drive.samples[i - 1].simulated_time_s, now.simulated_time_s)))
      from = i;
    while (from < i && drive.samples[from + 1].simulated_time_s <= now.simulated_time_s - braking_s) ++from;
    const double over_s = now.simulated_time_s - drive.samples[from].simulated_time_s;
    const double from_s = drive.samples[from].simulated_time_s;
    const bool by_instructor = std::ranges::any_of(drive.instructor_s, [&](const auto& time) {
      return from_s <= time.second && now.simulated_time_s >= time.first;
    });
    if (by_instructor || over_s < braking_s || now.speed_mps < braking_from_mps) continue;
    moments.push_back({now.simulated_time_s, std::max(0.0, (drive.samples[from].speed_mps - now.speed_mps) / over_s)});
  }
  return moments;
}

std::vector<Moment> mirrors(const DriveSeen& drive) {
  std::vector<Moment> moments;
  for (const LaneChange& change : drive.changes) {
    double ago_s = change.simulated_time_s - drive.samples.front().simulated_time_s;
    for (const Glance& glance : drive.glances)
      if (glance.start_s <= change.simulated_time_s) ago_s = std::min(ago_s, change.simulated_time_s - glance.start_s);
    moments.push_back({change.simulated_time_s, ago_s});
  }
  return moments;
}

/// Times without a glance, each dated at its end. Standing still, and a gap in the samples, begin a new one.
std::vector<Moment> lookouts(const DriveSeen& drive) {
  std::vector<Moment> moments;
  std::optional<double> since_s;
  auto glance = drive.glances.begin();
  const Sample* before = nullptr;
  for (const Sample& sample : drive.samples) {
    const double now_s = sample.simulated_time_s;
    const bool broken = sample.speed_mps < driving_mps || (before && is_gap(*before, sample));
    bool looked = false;
    for (; glance != drive.glances.end() && glance->start_s <= now_s; ++glance) looked = true;
    if (since_s && (broken || looked)) moments.push_back({now_s, now_s - *since_s});
    if (broken)
      since_s.reset();
    else if (looked || !since_s)
      since_s = now_s;
    before = &sample;
  }
  if (since_s && before) moments.push_back({before->simulated_time_s, before->simulated_time_s - *since_s});
  return moments;
}

/// The first sample at rest after driving.
std::optional<std::size_t> first_halt(const DriveSeen& drive) {
  bool drove = false;
  for (std::size_t i = 0; i < drive.samples.size(); ++i) {
    drove = drove || drive.samples[i].speed_mps > driving_mps;
    if (drove && std::abs(drive.samples[i].speed_mps) < standing_mps) return i;
  }
  return std::nullopt;
}

std::vector<Moment> hazards(const DriveSeen& drive) {
  const auto halt = first_halt(drive);
  if (!halt) return {};
  const double halt_s = drive.samples[*halt].simulated_time_s;
  // A driver who has switched them on before is in time.
  for (const Sample& sample : drive.samples)
    if (sample.simulated_time_s > halt_s - blink_s && sample.lamps.has(Lamp::indicator_left) &&
        sample.lamps.has(Lamp::indicator_right))
      return {{halt_s, std::max(0.0, sample.simulated_time_s - halt_s)}};
  return {{halt_s, drive.samples.back().simulated_time_s - halt_s}};
}

std::vector<Moment> perceptions(const DriveSeen& drive) {
  std::vector<Moment> moments;
  for (const HazardReaction& reaction : find_hazard_reactions(drive.events, drive.samples))
    if (reaction.counts())
      moments.push_back(
          {reaction.visible_s, reaction.time_s,
           reaction.response == HazardResponse::censored ? reaction.name + ", without any reaction" : reaction.name});
  return moments;
}

/// Of the driver's car; 0 without a record that has it.
double delta_v_of(const std::optional<CrashRecord>& crash) {
  return crash ? glm::length(crash->of_first.delta_v_mps.value_or(Vec2(0.0))) : 0.0;
}

std::string blow_text(const CrashedBody& car) {
  return fmt::format("the hardest changed the car's speed by {:.0f} km/h{}{}",
                     kmh_per_mps * glm::length(car.delta_v_mps.value_or(Vec2(0.0))),
                     car.principal_direction_rad ? ", a blow " : "",
                     car.principal_direction_rad ? whence(*car.principal_direction_rad) : "");
}

std::vector<Moment> moments_of(LessonMeasure measure, const DriveSeen& drive) {
  using Found = std::optional<double>;
  if (drive.samples.empty()) return {};
  switch (measure) {
    case LessonMeasure::speed:
      return each_sample(drive, [](const Sample& sample) -> Found { return 3.6 * std::abs(sample.speed_mps); });
    case LessonMeasure::gap:
      return each_sample(drive, [](const Sample& sample) -> Found {
        if (!sample.leader || sample.speed_mps < driving_mps) return std::nullopt;
        return std::max(0.0, sample.leader->distance_gap_m) / sample.speed_mps;
      });
    case LessonMeasure::position:
      return each_sample(drive, [&](const Sample& sample) -> Found {
        const auto changes = [&](const LaneChange& change) {
          return std::abs(change.simulated_time_s - sample.simulated_time_s) < around_change_s;
        };
        if (sample.lane == 0 || std::ranges::any_of(drive.changes, changes)) return std::nullopt;
        return std::abs(sample.lateral_position_m);
      });
    case LessonMeasure::indicator:
      return indicators(drive);
    case LessonMeasure::mirror:
      return drive.head_is_known ? mirrors(drive) : std::vector<Moment>{};
    case LessonMeasure::lookout:
      return drive.head_is_known ? lookouts(drive) : std::vector<Moment>{};
    case LessonMeasure::stop: {
      const auto halt = first_halt(drive);
      if (!halt || !drive.samples[*halt].leader) return {};
      return {{drive.samples[*halt].simulated_time_s, drive.samples[*halt].leader->distance_gap_m}};
    }
    case LessonMeasure::hazard:
      return hazards(drive);
    case LessonMeasure::yielding:
      return yieldings(drive);
    case LessonMeasure::turn:
      return turns(drive);
    case LessonMeasure::limit:
      return limits(drive);
    case LessonMeasure::braking:
      return brakings(drive);
    case LessonMeasure::perception:
      return perceptions(drive);
    case LessonMeasure::collision:
      break;
  }
  std::vector<Moment> moments{{drive.samples.front().simulated_time_s, 0.0}};
  const std::vector<CrashRecord> crashes = find_crashes(drive.events);
  double count = 0.0, by_others = 0.0;
  std::optional<CrashRecord> hardest;
  for (const Event& event : drive.events) {
    if (event.kind != "collision") continue;
    // Behind it a solid's name may follow.
    if ((event.detail + ' ').find(" by=other ") != std::string::npos) ++by_others;
    if (auto crash = crash_of(event, crashes); crash && delta_v_of(crash) > delta_v_of(hardest))
      hardest = std::move(*crash);
    std::string told = by_others > 0.0 ? fmt::format("{:.0f} of them ran into the pupil's car", by_others) : "";
    if (hardest) told += (told.empty() ? "" : "; ") + blow_text(hardest->of_first);
    moments.push_back({event.simulated_time_s, ++count, std::move(told)});
  }
  return moments;
}

/// Excess over the bound, in the measure's unit; below 0 within it.
double excess_of(const LessonTask& task, const Moment& moment) {
  return is_at_most(task.measure) ? moment.value - task.bound : task.bound - moment.value;
}

/// Severity of an excess.
Severity severity_of(const LessonTask& task, double excess) {
  if (task.measure == LessonMeasure::collision) return Severity::dangerous;
  return excess >= task.tolerance ? Severity::serious : Severity::minor;
}

TaskMark mark_task(const LessonTask& task, const DriveSeen& drive) {
  TaskMark result;
  double worst_excess = 0.0;
  for (const Moment& moment : moments_of(task.measure, drive)) {
    if (moment.time_s < task.from_s || moment.time_s > task.to_s) continue;
    const double excess = excess_of(task, moment);
    result.faults += excess > 0.0;
    if (result.occasions++ > 0 && excess <= worst_excess) continue;
    worst_excess = excess;
    result.worst = moment.value;
    result.worst_s = moment.time_s;
    result.worst_at = moment.at;
  }
  if (result.occasions == 0) return result;
  result.mark = 10.0 * std::clamp(1.0 - worst_excess / task.tolerance, 0.0, 1.0);
  if (worst_excess > 0.0) result.severity = severity_of(task, worst_excess);
  return result;
}

void add_faults(std::size_t index, const LessonTask& task, const DriveSeen& drive, std::vector<LessonFault>& faults) {
  constexpr double apart_s = 2.0;
  const bool lasts = is_of_each_sample(task.measure);
  LessonFault* going_on = nullptr;
  double worst_excess = 0.0;
  for (const Moment& moment : moments_of(task.measure, drive)) {
    if (moment.time_s < task.from_s || moment.time_s > task.to_s) continue;
    const double excess = excess_of(task, moment);
    if (excess <= 0.0) continue;
    if (!lasts || !going_on || moment.time_s - going_on->to_s > apart_s) {
      going_on = &faults.emplace_back(LessonFault{.task = index, .from_s = moment.time_s});
      worst_excess = 0.0;
    }
    going_on->to_s = moment.time_s;
    if (excess <= worst_excess) continue;
    worst_excess = excess;
    going_on->worst = moment.value;
    going_on->worst_s = moment.time_s;
    going_on->worst_at = moment.at;
    going_on->severity = severity_of(task, excess);
  }
}

DriveSeen seen_of(std::span<const Sample> samples, std::span<const Event> events) {
  DriveSeen drive{samples, events, find_lane_changes(samples, {}, put_before_ticks(events)), find_glances(samples),
                  false};
  drive.head_is_known = is_head_known(samples);
  for (const Event& event : events) {
    if (is_put(event)) drive.put_s.push_back(event.simulated_time_s);
    if (event.kind != "operator") continue;
    const std::string_view wish = word_of(event, "wish");
    if (wish == "brake") drive.instructor_s.emplace_back(event.simulated_time_s, 1e9);
    if (wish == "brake_off" && !drive.instructor_s.empty()) drive.instructor_s.back().second = event.simulated_time_s;
  }
  return drive;
}

}  // namespace

double settles_s(LessonMeasure measure) { return measure == LessonMeasure::position ? around_change_s : 0.0; }

std::vector<LessonFault> find_faults(const Lesson& lesson, std::span<const Sample> samples,
                                     std::span<const Event> events) {
  const DriveSeen drive = seen_of(samples, events);
  std::vector<LessonFault> faults;
  for (std::size_t i = 0; i < lesson.tasks.size(); ++i) add_faults(i, lesson.tasks[i], drive, faults);
  std::ranges::stable_sort(faults, {}, &LessonFault::from_s);
  return faults;
}

bool is_at_most(LessonMeasure measure) {
  constexpr std::array least{LessonMeasure::gap, LessonMeasure::indicator, LessonMeasure::stop, LessonMeasure::yielding,
                             LessonMeasure::turn};
  return std::ranges::find(least, measure) == least.end();
}

bool is_of_glances(LessonMeasure measure) {
  return measure == LessonMeasure::mirror || measure == LessonMeasure::lookout;
}

bool is_of_each_sample(LessonMeasure measure) {
  constexpr std::array each{LessonMeasure::speed, LessonMeasure::gap, LessonMeasure::position, LessonMeasure::limit,
                            LessonMeasure::braking};
  return std::ranges::find(each, measure) != each.end();
}

std::string_view name_of(Severity severity) {
  switch (severity) {
    case Severity::none:
      return "none";
    case Severity::minor:
      return "minor";
    case Severity::serious:
      return "serious";
    case Severity::dangerous:
      return "dangerous";
  }
  return "";
}

LessonMarks mark_lesson(const Lesson& lesson, std::span<const Sample> samples, std::span<const Event> events) {
  const DriveSeen drive = seen_of(samples, events);
  LessonMarks marks;
  marks.head_is_known = drive.head_is_known;
  double sum = 0.0, weights = 0.0;
  bool danger = false;
  for (const LessonTask& task : lesson.tasks) {
    const TaskMark& mark = marks.tasks.emplace_back(mark_task(task, drive));
    danger = danger || mark.severity == Severity::dangerous;
    if (!mark.mark) continue;
    sum += task.weight * *mark.mark;
    weights += task.weight;
  }
  const double driven_s = samples.empty() ? 0.0 : samples.back().simulated_time_s - samples.front().simulated_time_s;
  marks.taken = driven_s >= lesson.shortest_s;
  if (marks.taken && weights > 0.0) marks.mark = sum / weights;
  marks.passed = marks.taken && marks.mark && *marks.mark >= lesson.pass_mark && !danger;
  return marks;
}

std::string_view outcome_of(const LessonMarks& marks) {
  if (marks.passed) return "passed";
  return marks.taken ? "not passed" : "too short to be marked";
}

}  // namespace septet::logging

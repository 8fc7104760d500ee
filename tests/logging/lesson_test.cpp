// Lessons: marked tasks, their marks, and the learner's texts.

#include <cmath>
#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "logging/study/lesson/debrief.hpp"
#include "logging/study/lesson/lesson.hpp"
#include "tests/checkout.hpp"
#include "tests/relative.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::logging {
namespace {

/// A minute at 20 m/s in the middle of a lane, a car 50 m ahead, ten samples a second; a glance each five seconds.
std::vector<Sample> good_drive() {
  std::vector<Sample> samples;
  for (int i = 0; i < 600; ++i) {
    Sample sample;
    sample.tick = static_cast<Tick>(12 * i);
    sample.simulated_time_s = 0.1 * i;
    sample.x_m = 2.0 * i;
    sample.speed_mps = 20.0;
    sample.lane = -2;
    sample.lane_width_m = 3.5;
    sample.leader = Leader{5, 50.0, 55.0, 20.0};
    if (i % 50 < 5) sample.gaze_heading_rad = 0.7;  // The left mirror.
    samples.push_back(sample);
  }
  return samples;
}

/// Into the lane to the left from the 260th sample, over the line at the 300th, with the indicator on for so long
/// before the car moves.
void change_lanes(std::vector<Sample>& samples, double signal_s) {
  for (int i = 260; i < 340; ++i) {
    samples[static_cast<std::size_t>(i)].lateral_position_m = (i < 300 ? 0.0 : -3.5) + 3.5 * (i - 260) / 80.0;
    if (i >= 300) samples[static_cast<std::size_t>(i)].lane = -1;
  }
  for (std::size_t i = 340; i < samples.size(); ++i) samples[i].lane = -1;
  if (signal_s <= 0.0) return;
  for (int i = 260 - static_cast<int>(std::lround(10.0 * signal_s)); i < 300; ++i)
    samples[static_cast<std::size_t>(i)].lamps.set(Lamp::indicator_left, i % 7 < 4);  // It blinks.
}

Lesson lesson_of(const std::string& measure, double bound, double tolerance) {
  const auto lesson =
      read_lesson("title = \"T\"\naim = \"A\"\n[[task]]\nid = \"a\"\nsays = \"Do it\"\nmeasure = \"" + measure +
                      "\"\nbound = " + std::to_string(bound) + "\ntolerance = " + std::to_string(tolerance) + "\n",
                  "x.lesson.toml");
  REQUIRE_MESSAGE(lesson.has_value(), why_not(lesson));
  return *lesson;
}

TaskMark mark_of(const std::string& measure, double bound, double tolerance, const std::vector<Sample>& samples,
                 const std::vector<Event>& events = {}) {
  return mark_lesson(lesson_of(measure, bound, tolerance), samples, events).tasks.at(0);
}

}  // namespace

TEST_CASE("a mark is ten within the bound, none at bound and tolerance, and even in between") {
  auto samples = good_drive();
  CHECK(*mark_of("speed", 72.0, 10.0, samples).mark == doctest::Approx(10.0));
  samples[200].speed_mps = 77.0 / 3.6;
  const TaskMark half = mark_of("speed", 72.0, 10.0, samples);
  CHECK(*half.mark == doctest::Approx(5.0));
  CHECK(half.severity == Severity::minor);
  CHECK(half.worst == doctest::Approx(77.0));
  CHECK(half.worst_s == doctest::Approx(20.0));
  CHECK(half.faults == 1);
  CHECK(half.occasions == samples.size());
  samples[200].speed_mps = 90.0 / 3.6;
  const TaskMark none = mark_of("speed", 72.0, 10.0, samples);
  CHECK(*none.mark == doctest::Approx(0.0));
  CHECK(none.severity == Severity::serious);
}

TEST_CASE("a gap is over one's own speed, and nobody ahead is nothing seen") {
  auto samples = good_drive();
  CHECK(*mark_of("gap", 2.0, 1.0, samples).mark == doctest::Approx(10.0));
  samples[100].leader->distance_gap_m = 30.0;
  CHECK(*mark_of("gap", 2.0, 1.0, samples).mark == doctest::Approx(5.0));
  for (Sample& sample : samples) sample.leader.reset();
  CHECK_FALSE(mark_of("gap", 2.0, 1.0, samples).mark.has_value());
}

TEST_CASE("a lane change is marked by indicator and mirror, and is no bad place in the lane") {
  auto samples = good_drive();
  CHECK_FALSE(mark_of("indicator", 3.0, 3.0, samples).mark.has_value());
  change_lanes(samples, 4.0);
  CHECK(*mark_of("indicator", 3.0, 3.0, samples).mark == doctest::Approx(10.0));
  CHECK(*mark_of("position", 0.3, 0.5, samples).mark == doctest::Approx(10.0));
  auto late = good_drive();
  change_lanes(late, 1.5);
  const TaskMark half_as_long = mark_of("indicator", 3.0, 3.0, late);
  CHECK(*half_as_long.mark == relative(5.0, 0.1));
  CHECK(half_as_long.worst_s == relative(26.0, 0.01));  // Where it began to move, 4 s before the line.
  auto unsignalled = good_drive();
  change_lanes(unsignalled, 0.0);
  CHECK(*mark_of("indicator", 3.0, 3.0, unsignalled).mark == doctest::Approx(0.0));
  CHECK(*mark_of("mirror", 5.0, 5.0, samples).mark == doctest::Approx(10.0));
  for (int i = 200; i < 310; ++i) samples[static_cast<std::size_t>(i)].gaze_heading_rad = 0.01;
  CHECK(*mark_of("mirror", 5.0, 20.0, samples).mark < 9.0);
}

TEST_CASE("where the head never moved no glance is marked, and a long time without one costs") {
  auto samples = good_drive();
  CHECK(*mark_of("lookout", 6.0, 10.0, samples).mark == doctest::Approx(10.0));
  for (int i = 100; i < 300; ++i) samples[static_cast<std::size_t>(i)].gaze_heading_rad = 0.01;
  const TaskMark blind = mark_of("lookout", 6.0, 28.0, samples);
  CHECK(*blind.mark < 6.0);
  CHECK(blind.worst == relative(25.0, 0.05));
  for (Sample& sample : samples) sample.gaze_heading_rad = 0.0;
  CHECK_FALSE(mark_of("lookout", 6.0, 10.0, samples).mark.has_value());
}

TEST_CASE("right of way is marked by the time that was left, and told with its place") {
  const auto samples = good_drive();
  const auto event = [](double time_s, const std::string& detail) {
    return Event{0, time_s, "right_of_way", std::nullopt, detail};
  };
  CHECK_FALSE(mark_of("yielding", 3.0, 3.0, samples).mark.has_value());
  const TaskMark kept = mark_of("yielding", 3.0, 3.0, samples, {event(10, "kind=lights margin_s=8.0 shows=green")});
  CHECK(*kept.mark == doctest::Approx(10.0));
  const TaskMark half =
      mark_of("yielding", 3.0, 3.0, samples,
              {event(10, "kind=crossing road=2 margin_s=1.5"), event(20, "kind=give_way margin_s=2.0")});
  CHECK(*half.mark == doctest::Approx(5.0));
  CHECK(half.worst_s == doctest::Approx(10.0));
  CHECK(half.worst_at.find("crossing") != std::string::npos);
  CHECK(half.faults == 2);
  const TaskMark red = mark_of("yielding", 3.0, 3.0, samples, {event(10, "kind=lights margin_s=0.0 shows=red")});
  CHECK(red.severity == Severity::serious);
  CHECK(red.worst_at.find("red") != std::string::npos);
  for (const char* none :
       {"", "kind=lights", "margin_s=", "margin_s=nan", "margin_s=1e999", "xmargin_s=1", "margin_s=1x"})
    CHECK_FALSE(mark_of("yielding", 3.0, 3.0, samples, {event(10, none)}).mark.has_value());
}

TEST_CASE("a turn is marked by the indicator of its side before it began") {
  auto samples = good_drive();
  for (int i = 180; i < 200; ++i) samples[static_cast<std::size_t>(i)].lamps.set(Lamp::indicator_right, i % 7 < 4);
  const auto turn = [](const std::string& side) {
    return std::vector{Event{0, 24.0, "turn", std::nullopt, "side=" + side + " road=73 began_s=20.0"}};
  };
  CHECK_FALSE(mark_of("turn", 1.5, 1.5, samples).mark.has_value());
  CHECK(*mark_of("turn", 1.5, 1.5, samples, turn("right")).mark == doctest::Approx(10.0));
  CHECK(*mark_of("turn", 1.5, 1.5, samples, turn("left")).mark == doctest::Approx(0.0));
  CHECK(mark_of("turn", 1.5, 1.5, samples, turn("left")).worst_s == doctest::Approx(20.0));
}

TEST_CASE("speed counts over the limit that is posted where one drives") {
  auto samples = good_drive();  // 72 km/h.
  const auto limit = [](double time_s, const std::string& kmh) {
    return Event{0, time_s, "speed_limit", std::nullopt, "kmh=" + kmh};
  };
  CHECK_FALSE(mark_of("limit", 3.0, 15.0, samples).mark.has_value());
  CHECK(*mark_of("limit", 3.0, 15.0, samples, {limit(0, "80")}).mark == doctest::Approx(10.0));
  // The log dates some events later than they were.
  const TaskMark village =
      mark_of("limit", 3.0, 15.0, samples,
              {limit(0, "80"), {0, 31.0, "debris", std::nullopt, ""}, limit(30, "60"), limit(40, "0")});
  CHECK(*village.mark == doctest::Approx(4.0));
  CHECK(village.worst_s == doctest::Approx(30.0));
  CHECK(village.worst_at.find("60") != std::string::npos);
}

TEST_CASE("a halt is marked by its distance and the hazard lights that follow it") {
  auto samples = good_drive();
  for (std::size_t i = 300; i < samples.size(); ++i)
    samples[i].speed_mps = 0.0, samples[i].leader->distance_gap_m = 6.0;
  CHECK(*mark_of("stop", 10.0, 8.0, samples).mark == doctest::Approx(5.0));
  CHECK(mark_of("hazard", 5.0, 15.0, samples).severity == Severity::serious);
  for (std::size_t i = 330; i < samples.size(); ++i) {
    samples[i].lamps.set(Lamp::indicator_left, i % 7 < 4);
    samples[i].lamps.set(Lamp::indicator_right, i % 7 < 4);
  }
  CHECK(*mark_of("hazard", 5.0, 15.0, samples).mark == doctest::Approx(10.0));
  CHECK_FALSE(mark_of("stop", 10.0, 8.0, good_drive()).mark.has_value());
}

TEST_CASE(
    "braking is marked by what speed is lost in half a second, and neither a shake nor the nod of coming to stand "
    "counts") {
  auto samples = good_drive();
  CHECK(*mark_of("braking", 3.4, 3.4, samples).mark == doctest::Approx(10.0));
  samples[250].longitudinal_acceleration_mps2 = -9.0;
  CHECK(*mark_of("braking", 3.4, 3.4, samples).mark == doctest::Approx(10.0));
  for (std::size_t i = 200; i < samples.size(); ++i)
    samples[i].speed_mps = std::max(1.9, 20.0 - 5.1 * std::min(samples[i].simulated_time_s - 20.0, 2.0));
  const TaskMark hard = mark_of("braking", 3.4, 3.4, samples);
  CHECK(*hard.mark == doctest::Approx(5.0));
  CHECK(hard.worst_s == doctest::Approx(20.5));
  for (std::size_t i = 400; i < samples.size(); ++i) samples[i].speed_mps = 0.0;
  CHECK(*mark_of("braking", 3.4, 3.4, samples).mark == doctest::Approx(5.0));
  // A car that returns from a gap in the log has not braked in it.
  auto gap = good_drive();
  for (std::size_t i = 300; i < gap.size(); ++i) gap[i].speed_mps = 10.0, gap[i].simulated_time_s += 60.0;
  CHECK(*mark_of("braking", 3.4, 3.4, gap).mark == doctest::Approx(10.0));
}

TEST_CASE("a collision is dangerous, whatever the rest is worth") {
  Lesson lesson = lesson_of("collision", 0.0, 1.0);
  lesson.tasks.push_back(lesson_of("speed", 100.0, 10.0).tasks[0]);
  lesson.tasks.back().weight = 100.0;
  const auto samples = good_drive();
  CHECK(mark_lesson(lesson, samples, {}).passed);
  const std::vector<Event> events{{1200, 10.0, "collision", 7, ""}};
  const LessonMarks marks = mark_lesson(lesson, samples, events);
  CHECK(marks.tasks[0].severity == Severity::dangerous);
  CHECK(*marks.mark > 9.0);
  CHECK_FALSE(marks.passed);
}

TEST_CASE("the debrief says how many of those touched ran into the pupil's car") {
  const Lesson lesson = lesson_of("collision", 0.0, 1.0);
  const auto samples = good_drive();
  const std::vector<Event> own{{1200, 10.0, "collision", 7, "closing_speed_mps=4.00 delta_v_mps=2.00 by=driver"}};
  std::vector<Event> both = own;
  both.push_back({1300, 10.8, "collision", 8, "closing_speed_mps=3.00 delta_v_mps=1.50 by=other"});
  const auto page_of = [&](const std::vector<Event>& events) {
    return debrief_page(lesson, mark_lesson(lesson, samples, events), samples, {});
  };
  CHECK(page_of(own).find("ran into") == std::string::npos);
  CHECK(page_of(both).find("2 touched, the last at 10.8 s; 1 of them ran into the pupil") != std::string::npos);
}

TEST_CASE("a drive that ends too early has no mark, and line and debrief say that it was too short to be marked") {
  Lesson lesson = lesson_of("speed", 100.0, 10.0);
  const auto samples = good_drive();
  lesson.shortest_s = samples.back().simulated_time_s - samples.front().simulated_time_s;
  const LessonMarks taken = mark_lesson(lesson, samples, {});
  CHECK(taken.passed);
  CHECK(marks_in_a_line(lesson, taken).starts_with("mark 10.0 of 10, passed"));
  CHECK(debrief_page(lesson, taken, samples, {}).find(">10.0<") != std::string::npos);
  lesson.shortest_s += 0.1;
  const LessonMarks marks = mark_lesson(lesson, samples, {});
  CHECK_FALSE(marks.mark.has_value());
  CHECK_FALSE(marks.passed);
  CHECK(marks_in_a_line(lesson, marks).starts_with("too short to be marked"));
  const std::string page = debrief_page(lesson, marks, samples, {});
  CHECK(page.find("<b>too short to be marked</b>") != std::string::npos);
  CHECK(page.find(">10.0<") == std::string::npos);
  CHECK(page.find("<b>–") != std::string::npos);
  CHECK(page.find("is needed, and nothing dangerous") == std::string::npos);
}

TEST_CASE("an empty drive is not seen, and not passed") {
  const LessonMarks marks = mark_lesson(lesson_of("speed", 72.0, 10.0), {}, {});
  CHECK_FALSE(marks.mark.has_value());
  CHECK_FALSE(marks.passed);
  CHECK(debrief_page(lesson_of("speed", 72.0, 10.0), marks, {}, {}).find("not seen") != std::string::npos);
}

TEST_CASE("the debrief shows where and why with the picture of the moment, and no markup of the lesson's own") {
  auto samples = good_drive();
  samples[123].speed_mps = 30.0;
  Lesson lesson = lesson_of("speed", 72.0, 10.0);
  lesson.title = "<script>alert(1)</script>";
  const LessonMarks marks = mark_lesson(lesson, samples, {});
  const std::string page = debrief_page(lesson, marks, samples, {"screens/ahead", {0, 121, 1443, 1561}, 120.0});
  CHECK(page.find("108.0 km/h at 12.3 s") != std::string::npos);
  CHECK(page.find("screens/ahead/1443.png\" alt=\"The screen ahead 12 s") != std::string::npos);
  CHECK(page.find("--from 9") != std::string::npos);
  CHECK(page.find("<script>") == std::string::npos);
  CHECK(page.find("<polyline") != std::string::npos);
  CHECK(marks_in_a_line(lesson, marks).find("not passed") != std::string::npos);
  CHECK(page.find("asked: at most 72.0 km/h; not kept for 1 % of the time") != std::string::npos);
  // The learner's own mark first: the lesson's is shown when asked for.
  const std::size_t own = page.find("which mark would you give yourself"), shown = page.find("<details>");
  CHECK(own < shown);
  CHECK(shown < page.find("of 10</small>"));
}

TEST_CASE(
    "the debrief names only pictures that are there, whatever ticks a screen has shown and whatever else lies beside "
    "them") {
  auto samples = good_drive();
  samples[123].speed_mps = 30.0;
  const Lesson lesson = lesson_of("speed", 72.0, 10.0);
  const LessonMarks marks = mark_lesson(lesson, samples, {});
  TemporaryFolder folder;
  for (const char* name : {"1590.png", "1477.png", "119.png", "server-lost.png", "-3.png", "1475.txt",
                           "99999999999999999999.png", "x.png", "7x.png"})
    std::ofstream(folder / name) << "x";
  const auto ticks = picture_ticks_in(folder.path());
  CHECK(ticks == std::vector<std::int64_t>{119, 1477, 1590});
  CHECK(picture_ticks_in(folder / "nowhere").empty());
  // 12.3 s are tick 1476.
  CHECK(debrief_page(lesson, marks, samples, {"here", ticks, 120.0}).find("here/119.png") != std::string::npos);
  CHECK(debrief_page(lesson, marks, samples, {"here", {1477, 1590}, 120.0}).find("here/1477.png") != std::string::npos);
  CHECK(debrief_page(lesson, marks, samples, {"here", {}, 120.0}).find("<img") == std::string::npos);
}

TEST_CASE("mistakes in a lesson are named, and the shipped ones have none") {
  for (const char* text :
       {"", "title = 3", "[[task]]\nid = \"a\"", "[[task]]\nid = \"a\"\nsays = \"b\"\nmeasure = \"joy\"", "task = 3",
        "[[task]]\nid = \"a\"\nsays = \"b\"\nmeasure = \"gap\"\nbound = -1",
        "[[task]]\nid = \"a\"\nsays = \"b\"\nmeasure = \"gap\"\nbound = nan",
        "[[task]]\nid = \"a\"\nsays = \"b\"\nmeasure = \"gap\"\ntypo = 1"}) {
    INFO(std::string(text));
    const auto lesson = read_lesson(text, "x.toml");
    REQUIRE_FALSE(lesson.has_value());
    CHECK_FALSE(lesson.error().remedy.empty());
  }
  for (const std::string name : {"first-lesson", "winter-lorry", "tunnel-fire", "behind-ambulance"}) {
    const std::string path = fmt::format("{}/scenarios/{}/{}.lesson.toml", source_folder(), name, name);
    const auto text = read_regular_file(path);
    REQUIRE(text.has_value());
    const auto lesson = read_lesson(*text, path);
    CHECK_MESSAGE(lesson.has_value(), why_not(lesson));
  }
}

TEST_CASE("a fault lasts from the first sample beyond the bound to the last, and two apart are two") {
  auto samples = good_drive();
  const auto fast = [&](std::size_t from, std::size_t to, double mps) {
    for (std::size_t i = from; i < to; ++i) samples[i].speed_mps = mps;
  };
  fast(100, 150, 30.0);
  fast(160, 170, 40.0);  // A second later: the same one.
  fast(400, 420, 26.0);
  const Lesson lesson = lesson_of("speed", 80.0, 20.0);
  const auto faults = find_faults(lesson, samples, {});
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].from_s == relative(10.0, 1e-9));
  CHECK(faults[0].to_s == relative(16.9, 1e-9));
  CHECK(faults[0].worst == relative(144.0, 1e-9));
  CHECK(faults[0].worst_s == relative(16.0, 1e-9));
  CHECK(faults[0].severity == Severity::serious);
  CHECK(faults[1].severity == Severity::minor);
  CHECK(faults[1].from_s == relative(40.0, 1e-9));
  const auto marks = mark_lesson(lesson, samples, {});
  CHECK(marks.tasks[0].worst == faults[0].worst);
  CHECK(marks.tasks[0].worst_s == faults[0].worst_s);
}

TEST_CASE("where nothing is wrong there is no fault, and each collision is one of its own") {
  const auto samples = good_drive();
  for (const char* measure : {"speed", "gap", "position", "lookout", "collision", "limit", "braking"})
    CHECK(find_faults(lesson_of(measure, measure == std::string("gap") ? 1.0 : 100.0, 1.0), samples, {}).empty());
  const std::vector<Event> events{
      {.tick = 1200, .simulated_time_s = 10.0, .kind = "collision", .participant = {}, .detail = ""},
      {.tick = 1300, .simulated_time_s = 10.8, .kind = "collision", .participant = {}, .detail = ""}};
  const auto faults = find_faults(lesson_of("collision", 0.0, 1.0), samples, events);
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].severity == Severity::dangerous);
  CHECK(faults[1].from_s == 10.8);
}

TEST_CASE(
    "where one drives in a lane is excused by the change of lanes that follows, within the time that the fault settles "
    "in") {
  auto samples = good_drive();
  change_lanes(samples, 3.0);
  const Lesson lesson = lesson_of("position", 1.0, 1.0);
  const std::span<const Sample> all(samples);
  CHECK_FALSE(find_faults(lesson, all.first(298), {}).empty());  // Nothing has crossed a line yet.
  CHECK(find_faults(lesson, all, {}).empty());
  const auto early = find_faults(lesson, all.first(298), {});
  CHECK(early.front().from_s + settles_s(LessonMeasure::position) > 29.8);
}

TEST_CASE("without a head tracker tasks of mirrors are not known in the debrief and the rest is marked") {
  std::vector<Sample> samples = good_drive();
  change_lanes(samples, 3.0);
  const auto lesson = lesson_of("mirror", 3.0, 2.0);
  const std::string with_head = debrief_page(lesson, mark_lesson(lesson, samples, {}), samples, {});
  CHECK(with_head.find("not known") == std::string::npos);
  for (Sample& sample : samples) sample.gaze_heading_rad = 0.0;
  for (const char* measure : {"mirror", "lookout"}) {
    const auto task = lesson_of(measure, 3.0, 2.0);
    const std::string page = debrief_page(task, mark_lesson(task, samples, {}), samples, {});
    CHECK_MESSAGE(page.find("not known: nothing told where the head pointed") != std::string::npos, measure);
    CHECK_MESSAGE(page.find("no occasion") == std::string::npos, measure);
  }
  const auto stop = lesson_of("stop", 3.0, 2.0);
  CHECK(debrief_page(stop, mark_lesson(stop, samples, {}), samples, {}).find("no occasion") != std::string::npos);
}

TEST_CASE("the command that shows a moment again stays on one line") {
  std::vector<Sample> samples = good_drive();
  const auto lesson = lesson_of("speed", 50.0, 10.0);
  const std::string page = debrief_page(lesson, mark_lesson(lesson, samples, {}), samples, {});
  CHECK(page.find("<code style=\"white-space: nowrap\">septet replay session.sqlite --from 0</code>") !=
        std::string::npos);
}

}  // namespace septet::logging

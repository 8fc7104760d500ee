// Records of crashes in a log: to which touch they belong, their words, and what summary, report and lessons tell of them.

#include "logging/study/measures/crashes.hpp"

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "logging/study/lesson/lesson.hpp"
#include "logging/study/report/crash_section.hpp"
#include "logging/study/report/measure_list.hpp"
#include "logging/study/report/report.hpp"
#include "logging/study/report/summary.hpp"
#include "logging/study/report/told_event.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/relative.hpp"

namespace septet::logging {
namespace {

CrashRecord crash_at(Tick tick, ParticipantId first, std::optional<ParticipantId> second) {
  CrashRecord crash;
  crash.tick = tick;
  crash.ticks = 8;
  crash.first = first;
  crash.second = second;
  if (!second) crash.stands = "guard rail";
  crash.closing_speed_mps = 13.5;
  crash.overlap_m = 0.91;
  crash.overlap_share = 0.5;
  crash.of_first.mass_kg = 1500.0;
  crash.of_first.delta_v_mps = Vec2(-6.0, 2.5);
  crash.of_first.principal_direction_rad = -0.39;
  crash.of_first.crush_m = 0.38;
  if (second) crash.of_second.delta_v_mps = Vec2(6.0, -2.5);
  crash.ledger = CrashLedger{200e3, 120e3, 70e3, 6e3, 500.0, 3500.0};
  crash.pulse_ns = {Vec2(1e3, 0.0), Vec2(4e3, 100.0), Vec2(3e3, 50.0)};
  return crash;
}

Event told(const CrashRecord& crash, Tick after = 14) {
  const Tick tick = crash.tick + crash.ticks + after;
  return {tick, static_cast<double>(tick) / 120.0, std::string(crash_event), crash.first, text_of(crash)};
}

Event touch(Tick tick, const char* kind, std::optional<ParticipantId> who, const std::string& detail) {
  return {tick, static_cast<double>(tick) / 120.0, kind, who, detail};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a touch has the record that began with it, of the same two, and of what stands the one before it") {
  const std::vector<Event> events{touch(240, "collision", 3, "closing_speed_mps=13.50 delta_v_mps=6.2 by=driver"),
                                  told(crash_at(240, 1, 3)),
                                  touch(400, "crash_of_others", 3, "with=5 closing_speed_mps=13.50"),
                                  told(crash_at(400, 3, 5)),
                                  told(crash_at(600, 1, std::nullopt)),
                                  touch(630, "collision", std::nullopt, "guard rail closing_speed_mps=13.50"),
                                  touch(900, "collision", 3, "closing_speed_mps=2.00"),
                                  touch(900, "collision", std::nullopt, "tree closing_speed_mps=2.00"),
                                  {950, 8.0, "crash", 1, "version=7 tick=3"},
                                  {950, 8.0, "crash", std::nullopt, text_of(crash_at(900, 1, 3))}};
  const auto crashes = find_crashes(events);
  REQUIRE(crashes.size() == 3);
  CHECK(crash_of(events[0], crashes) == crashes[0]);
  CHECK(crash_of(events[2], crashes) == crashes[1]);
  CHECK(crash_of(events[5], crashes) == crashes[2]);
  CHECK_FALSE(crash_of(events[6], crashes).has_value());
  CHECK_FALSE(crash_of(events[7], crashes).has_value());
}

TEST_CASE("two crashes with one participant at one tick: the collision is the driver's, who has the least number") {
  const std::vector<CrashRecord> crashes{crash_at(240, 2, 3), crash_at(240, 1, 3)};
  const auto mine = crash_of(touch(240, "collision", 3, ""), crashes);
  REQUIRE(mine.has_value());
  CHECK(mine->first == 1);
}

TEST_CASE("whence a blow came is told by eighths of a turn") {
  const double degree = std::numbers::pi / 180.0;
  CHECK(whence(0.0) == "from ahead");
  CHECK(whence(-22.0 * degree) == "from ahead");
  CHECK(whence(23.0 * degree) == "from ahead, left");
  CHECK(whence(90.0 * degree) == "from the left");
  CHECK(whence(180.0 * degree) == "from behind");
  CHECK(whence(-180.0 * degree) == "from behind");
  CHECK(whence(-90.0 * degree) == "from the right");
  CHECK(whence(-44.0 * degree) == "from ahead, right");
  CHECK(whence(1e30) != "");
}

TEST_CASE("a crash's sentence has what was measured, and nothing of what was not") {
  CHECK(crash_text(crash_at(240, 1, 3), {}) ==
        "participants 1 and 3 met at 49 km/h; 1: ΔV 23 km/h, from ahead, crushed by 0.38 m; 3: ΔV 23 km/h");
  CrashRecord bare;
  bare.first = 1;
  bare.stands = "tree";
  bare.closing_speed_mps = 5.0;
  CHECK(crash_text(bare, {}) == "participant 1 and tree met at 18 km/h");
  const auto sentences = tell_events({told(crash_at(240, 1, 3))}, {});
  CHECK(has(sentences[0].says, "crash: participants 1 and 3 met"));
  CHECK(sentences[0].row->title == "collisions");
}

TEST_CASE("the list of what happened calls those who met by the scenario's names") {
  const ParticipantNames names{{1, "ego"}, {3, "crosser"}};
  const auto event = [](std::string_view kind, ParticipantId participant, std::string_view detail) {
    return Event{.kind = std::string(kind), .participant = participant, .detail = std::string(detail)};
  };
  const auto sentences =
      tell_events({event("collision", 3, "closing_speed_mps=10"), event("collision", 4, ""),
                   event("crash_of_others", 3, "with=4 by=4 closing_speed_mps=10"), told(crash_at(240, 1, 3))},
                  names);
  CHECK(sentences[0].says == "collision with 3 crosser at a closing speed of 36 km/h");
  CHECK(sentences[1].says == "collision with participant 4");
  CHECK(sentences[2].says == "participant 4 ran into 3 crosser at a closing speed of 36 km/h");
  CHECK(has(sentences[3].says, "crash: participants 1 ego and 3 crosser met at 49 km/h; 1 ego: ΔV 23 km/h"));
}

TEST_CASE(
    "of a contact that lasts sentence and report tell how long, of a blow and of earlier builds' records nothing") {
  CrashRecord crash = crash_at(120, 1, 3);
  const auto section = [&] { return crash_section({&crash, 1}, 120.0, {}); };
  for (const std::optional<double> contact_s : {std::optional<double>(), std::optional(0.4)}) {
    crash.contact_s = contact_s;
    CHECK(crash_text(crash, {}).find("in contact") == std::string::npos);
    CHECK(section().find("in contact") == std::string::npos);
  }
  for (const auto& [contact_s, words] : {std::pair(1.25, "1.2 s"), std::pair(1.975, "2 s or longer")}) {
    crash.contact_s = contact_s;
    const auto read = read_crash(1, text_of(crash));
    REQUIRE(read.has_value());
    CHECK(read->contact_s == contact_s);
    CHECK(crash_text(*read, {}).find(std::string("; in contact for ") + words) != std::string::npos);
    CHECK(section().find(std::string("they stayed in contact for ") + words) != std::string::npos);
  }
}

TEST_CASE("the report shows each crash with its energies and its pulse, and a dash for what was not measured") {
  const std::vector<CrashRecord> crashes{crash_at(240, 1, 3)};
  const std::string html = crash_section(crashes, 120.0, {{3, "crosser"}});
  for (const char* part :
       {"2.00 s: 1 and 3 crosser", "48.6 km/h", "0.91 m, 50 %", "23.4", "0.38", "–", ">70.00<", ">6.00<", "Pulse"})
    CHECK_MESSAGE(has(html, part), part);
  CHECK(crash_section({}, 120.0, {}).empty());
  CrashRecord strange = crashes[0];
  strange.second.reset();
  strange.stands = "<script>";
  CHECK_FALSE(has(crash_section({&strange, 1}, 120.0, {{1, "<script>"}}), "<script>"));
  const std::vector<CrashRecord> many(30, crashes[0]);
  CHECK(has(crash_section(many, 120.0, {}), "And 10 more."));
}

TEST_CASE("summary and measures of a session have its crashes, and of a session of an earlier build none") {
  const TemporaryFolder folder;
  for (const bool is_new : {true, false}) {
    const auto file = folder.path() / (is_new ? "new.sqlite" : "old.sqlite");
    SessionWriter writer = must_create(file);
    for (Tick tick = 0; tick < 120; ++tick) {
      const Snapshot snapshot = drive_snapshot(tick);
      writer.record(taken(snapshot));
      if (is_sample_due(tick, 120.0)) writer.record(take_sample(snapshot, std::nullopt));
    }
    writer.record(touch(60, "collision", 3, "closing_speed_mps=13.50 delta_v_mps=6.20 by=driver"));
    if (is_new) writer.record(told(crash_at(60, 1, 3)));
    REQUIRE(writer.finish().has_value());
    const auto session = must_open(file);
    DriveSummary summary{.scenario = "", .rig = "", .outcome = {}, .log = {}};
    summary.log = summarise_log(session).value();
    const auto json = nlohmann::json::parse(to_json(summary));
    const std::size_t expected = is_new ? 1 : 0;
    CHECK(json["crashes"].size() == expected);
    const auto& measure = json["measures"]["collision_delta_v_largest_mps"];
    CHECK(measure["value"].is_null() == !is_new);
    CHECK(json["measures"]["collision_closing_speed_largest_mps"]["value"] == 13.5);
    if (!is_new) continue;
    CHECK(measure["value"].get<double>() == relative(6.5, 1e-9));
    const auto& crash = json["crashes"][0];
    CHECK(crash["first"] == 1);
    CHECK(crash["with"] == 3);
    CHECK(crash["crush_j"] == 70000);
    CHECK(crash["pulse_ns"][1][0] == 4000.0);
    CHECK_FALSE(crash.contains("its_crush_m"));
    const std::string html = to_html(read_report_data(session).value());
    CHECK(has(html, "<h2>Crashes</h2>"));
  }
}

TEST_CASE("a lesson's mark for collisions tells the hardest blow") {
  Lesson lesson;
  lesson.tasks.push_back({.id = "collision", .says = "Touch nobody", .measure = LessonMeasure::collision});
  lesson.tasks[0].tolerance = 1.0;
  std::vector<Sample> samples(100);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].simulated_time_s = 0.1 * static_cast<double>(i);
  const std::vector<Event> events{touch(240, "collision", 3, "closing_speed_mps=13.50 by=driver"),
                                  told(crash_at(240, 1, 3))};
  const LessonMarks marks = mark_lesson(lesson, samples, events);
  CHECK(marks.tasks[0].worst_at == "the hardest changed the car's speed by 23 km/h, a blow from ahead");
  const LessonMarks without = mark_lesson(lesson, samples, std::span(events).first(1));
  CHECK(without.tasks[0].worst_at.empty());
}

}  // namespace septet::logging

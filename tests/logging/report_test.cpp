#include "logging/study/report/report.hpp"
#include "logging/study/report/measure_table.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "engine/document/text_file.hpp"
#include "logging/study/drive_observer.hpp"
#include "logging/study/report/summary.hpp"
#include "tests/checkout.hpp"
#include "tests/logging/count_of.hpp"
#include "tests/logging/sample_series.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

/// Ten minutes with a lane change every 30 s and wandering within the lane.
ReportData example_drive() {
  std::vector<double> unrolled_m;
  for (int i = 0; i < 6000; ++i) {
    const double t = i / 10.0;
    const double lanes = std::sin(t * 3.14159265 / 30.0) > 0 ? 0.0 : -1.0;
    const double previous = unrolled_m.empty() ? -3.5 : unrolled_m.back();
    const double target = lanes * 3.5 + 0.25 * std::sin(t * 0.9) + 0.12 * std::sin(t * 2.3);
    unrolled_m.push_back(previous + std::clamp(target - previous, -0.12, 0.12));
  }
  ReportData data;
  data.info = example_info();
  data.samples = drive_through(unrolled_m);
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    Sample& sample = data.samples[i];
    const double t = sample.simulated_time_s;
    sample.speed_mps = 29.0 - 29.0 * std::exp(-t / 8.0) + 1.5 * std::sin(t / 11.0);
    sample.gaze_heading_rad = i % 97 < 6 ? -0.5 : i % 211 < 9 ? 0.7 : 0.02;
    sample.leader = Leader{4, 40 + 10 * std::sin(t / 20), 45 + 10 * std::sin(t / 20), 28};
  }
  data.events = {{100, 3.0, "scenario", std::nullopt, "ambulance"}, {1200, 70.0, "collision", 1, ""}};
  data.answers = {{"fun", "It was fun to drive", "agree", 4.0, 600.0, false, ""},
                  {"drive_completed", "", std::nullopt, std::nullopt, 412.0, true, "felt <sick>"}};
  return data;
}

DriveOutcome example_outcome() {
  DriveOutcome outcome{.end = DriveEnd::window_closed,
                       .error = "",
                       .ticks = 3600,
                       .simulated_s = 30.0,
                       .wall_s = 41.25,
                       .state_hash = 0xabc,
                       .inputs_hash = 0xdef,
                       .late_ticks = 3,
                       .bad_numbers = 5,
                       .lost_records = 4,
                       .log_waited_s = 1.5,
                       .screens = {}};
  outcome.screens = {{.name = "ahead-1",
                      .frames = 450,
                      .refused_ticks = 6,
                      .frame_ms_p50 = 21.5,
                      .frame_ms_p99 = std::nan(""),
                      .connected_s = {0.0, 12.5},
                      .left_s = {11.0},
                      .left_behind_s = {},
                      .has_reported = true},
                     {.name = "rear-2", .frames = 0, .connected_s = {0.0}, .left_s = {3.0}, .left_behind_s = {}}};
  return outcome;
}

}  // namespace

TEST_CASE("the summary says how the drive ended and what its screens saw and its measures in figures") {
  DriveSummary summary{
      .scenario = "motorway \"ambulance\"", .rig = "seven-screens", .seed = 7, .outcome = example_outcome(), .log = {}};
  const ReportData drive = example_drive();
  summary.log = DriveSummary::FromLog{2, compute_drive_measures(drive), {{"collision", 1}}};
  const auto json = nlohmann::json::parse(to_json(summary));
  CHECK(json["version"] == 1);
  CHECK(json["scenario"] == "motorway \"ambulance\"");
  CHECK(json["ended"] == "window_closed");
  CHECK(json["exit_status"] == 3);
  CHECK(json["error"].is_null());
  CHECK(json["state_hash"] == "0000000000000abc");
  CHECK(json["late_ticks"] == 3);
  CHECK(json["bad_numbers"] == 5);
  CHECK(json["log"]["lost_records"] == 4);
  CHECK(json["log"]["missing_ticks"] == 2);
  CHECK(json["log"]["waited_s"] == 1.5);
  CHECK(json["screens"][0]["connected_s"] == std::vector{0.0, 12.5});
  CHECK(json["screens"][0]["left_s"] == std::vector{11.0});
  CHECK(json["screens"][0]["refused_ticks"] == 6);
  CHECK(json["screens"][0]["frame_ms_p99"].is_null());  // Not a number.
  CHECK(json["lateral_position_histogram"]["counts"].size() == 21);
  std::size_t counted = 0;
  for (const auto& bin : json["lateral_position_histogram"]["counts"]) counted += bin.get<std::size_t>();
  CHECK(counted == 6000);
  CHECK(json["speed_mps"]["mean"].get<double>() == doctest::Approx(summary.log->measures.speed_mean_mps));
  CHECK(json["time_headway_s"]["median"].get<double>() ==
        doctest::Approx(*summary.log->measures.following.headway.median_s));
  CHECK(json["lateral_position_m"]["few_samples"] == false);
  CHECK(json["events"]["collision"] == 1);
  // Every key is explained.
  std::ifstream in(source_folder() + "/logging/study/report/SUMMARY.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  for (const auto& item : json.items()) CHECK_MESSAGE(page.find("`" + item.key()) != std::string::npos, item.key());
  for (const auto& item : json["screens"][0].items())
    CHECK_MESSAGE(page.find("." + item.key()) != std::string::npos, item.key());

  summary.log.reset();  // A log that was deleted.
  const auto poor = nlohmann::json::parse(to_json(summary));
  CHECK(poor["log"]["missing_ticks"].is_null());
  CHECK_FALSE(poor.contains("speed_mps"));
}

TEST_CASE("an outcome reads back as it was written and anything else is refused") {
  const DriveOutcome outcome = example_outcome();
  const auto back = read_outcome(to_json(outcome), "a.sqlite");
  REQUIRE(back.has_value());
  CHECK(to_json(*back) == to_json(outcome));
  CHECK(back->end == DriveEnd::window_closed);
  for (const std::string text : {"", "{}", "[1]", "nonsense", "{\"ended\": \"nonsense\"}", "{\"ended\": 3}"})
    CHECK_FALSE(read_outcome(text, "a.sqlite").has_value());
}

TEST_CASE(
    "the report says how the drive ended and what went wrong and which figures are of few samples and names no "
    "folder") {
  ReportData data = example_drive();
  data.info.files = {{"scenario", "/home/somebody/motorway.xosc", ""}, {"rig", "/home/somebody/three.toml", ""}};
  data.outcome = example_outcome();
  data.missing_ticks = 2;
  std::string html = to_html(data);
  CHECK(html.find("<h1>motorway</h1>") != std::string::npos);
  CHECK(html.find("/home") == std::string::npos);
  CHECK(html.find("a screen's window was closed") != std::string::npos);
  CHECK(html.find("3 of 3600 ticks began late") != std::string::npos);
  CHECK(html.find("5 numbers went bad") != std::string::npos);
  CHECK(html.find("2 ticks are missing") != std::string::npos);
  CHECK(html.find("0.0, 12.5 s") != std::string::npos);               // The first screen came back.
  CHECK(html.find("was not there at the end") != std::string::npos);  // The second one did not.
  CHECK(html.find("of only") == std::string::npos);
  data.samples.resize(4);
  html = to_html(data);
  CHECK(html.find("of only 4 samples") != std::string::npos);
}

TEST_CASE("the report shows the charts and one mark per lane change and needs no other file") {
  const ReportData data = example_drive();
  const auto measures = compute_drive_measures(data);
  const std::string html = to_html(data);
  if (const char* keep = std::getenv("SEPTET_KEEP_REPORT")) CHECK(document::write_text_file(keep, html));
  CHECK(count_of(html, "<svg") == 4);  // All but the route: this car's samples have no places.
  CHECK(count_of(html, "<rect class=\"bar") == 21);
  CHECK(count_of(html, "<rect class=\"bar strong\"") == 1);
  CHECK(measures.lane_changes.size() >= 19);
  CHECK(count_of(html, "class=\"mark\"") == static_cast<int>(measures.lane_changes.size()) + 2);
  CHECK(count_of(html, "the paper's centre bar") == 1);
  CHECK(count_of(html, "http") == 0);
  CHECK(count_of(html, "src=") == 0);
  CHECK(html.find("felt &lt;sick&gt;") != std::string::npos);
}

TEST_CASE("the report's curve of the speed is one line from the drive's start to its end, however fast it was") {
  for (const double times : {0.05, 1.0, 3.0}) {
    CAPTURE(times);
    ReportData data = example_drive();
    for (Sample& sample : data.samples) sample.speed_mps *= times;
    const std::string html = to_html(data);
    const auto chart = html.find(">Speed<"), line = html.find("<path class=\"line\" d=\"", chart);
    REQUIRE(line != std::string::npos);
    const std::string curve = html.substr(line + 22, html.find('"', line + 22) - line - 22);
    CHECK(count_of(curve, "M") == 1);
    CHECK(count_of(curve, "L") > 500);
  }
}

TEST_CASE("distance speed and headway of a drive equal those computed by hand") {
  std::vector<Sample> samples{sample_at(0, -1, 0), sample_at(1, -1, 0), sample_at(2, -1, 0)};
  samples[0].speed_mps = 10;
  samples[1].speed_mps = 20;
  samples[2].speed_mps = 30;
  samples[1].leader = Leader{2, 45, 50, 20};  // 2.5 s
  samples[2].leader = Leader{2, 25, 30, 20};  // 1.0 s
  DriveRecords records;
  records.samples = samples;
  const auto measures = compute_drive_measures(records);
  CHECK(measures.distance_m == doctest::Approx(0.1 * 15 + 0.1 * 25));
  CHECK(measures.speed_mean_mps == doctest::Approx(20));
  CHECK(measures.speed_sd_mps == doctest::Approx(std::sqrt(200.0 / 3)));
  CHECK(measures.following.headway.median_s.value() == doctest::Approx(1.75));
  CHECK(measures.following.headway.smallest_s.value() == doctest::Approx(1.0));
}

TEST_CASE("whoever drives at walking pace or slower follows nobody") {
  std::vector<Sample> samples;
  for (const double speed_mps : {0.5, 1.0, 1.5}) {
    samples.push_back(sample_at(static_cast<int>(samples.size()), -1, 0));
    samples.back().speed_mps = speed_mps;
    samples.back().leader = Leader{2, 1.0, 1.2, 1.0};
  }
  DriveRecords records;
  records.samples = samples;
  const FollowingMeasures following = compute_drive_measures(records).following;
  CHECK(following.samples == 1);
  CHECK(following.too_slow == 2);
  CHECK(following.headway.median_s.value() == doctest::Approx(0.8));
}

TEST_CASE("speeds are told in kilometres per hour") {
  DriveMeasures measures;
  measures.speed_mean_mps = 10.0;
  measures.speed_sd_mps = 2.5;
  measures.speed_largest_mps = 20.0;
  const std::string table = measure_table(measures, {});
  for (const char* told : {">36.0 km/h<", ">9.0 km/h<", ">72.0 km/h<"}) CHECK(table.find(told) != std::string::npos);
}

TEST_CASE("a sample's acceleration is forward and to the left of the car, whichever way it heads") {
  for (const double heading : {0.0, 1.1, 3.0}) {
    Snapshot snapshot;
    Participant car;
    car.id = 1;
    car.world_from_vehicle.orientation = orientation_from_angles(heading, 0.0, 0.0);
    car.acceleration_mps2 = car.world_from_vehicle.orientation * Vec3(1.5, 0.7, 0.0);
    snapshot.participants = {car};
    snapshot.driver_car.participant = 1;
    const Sample sample = take_sample(snapshot, std::nullopt);
    CHECK(sample.longitudinal_acceleration_mps2 == doctest::Approx(1.5));
    CHECK(sample.lateral_acceleration_mps2 == doctest::Approx(0.7));
  }
}

TEST_CASE("an empty session makes a report that says so") {
  ReportData data;
  data.ended_cleanly = false;
  const std::string html = to_html(data);
  CHECK(html.find("holds no samples") != std::string::npos);
  CHECK(html.find("no clean end") != std::string::npos);
  CHECK(count_of(html, "<svg") == 0);
}

TEST_CASE("a report that cannot be written is one clear error and leaves nothing behind") {
  const TemporaryFolder folder;
  const auto written = document::write_text_file(folder / "missing", "text");
  CHECK(written.has_value());
  const auto refused = document::write_text_file(folder / "no such folder/report.html", "text");
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().where.ends_with("report.html"));
  CHECK_FALSE(std::filesystem::exists(folder / "missing.part"));
}

TEST_CASE("the observer samples ten times a second and notes lane changes and glances") {
  DriveObserver observer;
  int samples = 0;
  std::vector<Event> events;
  for (Tick tick = 0; tick < 600; ++tick) {
    Snapshot snapshot = drive_snapshot(tick);
    const double unrolled_m = -3.5 + 0.01 * static_cast<double>(tick);
    snapshot.driver_car.lane = unrolled_m < -1.75 ? -2 : -1;
    snapshot.driver_car.lateral_position_m = unrolled_m < -1.75 ? unrolled_m + 3.5 : unrolled_m;
    snapshot.driver_car.gaze_heading_rad = tick > 100 && tick < 160 ? 0.7 : 0.0;
    const Observation observation = observe(observer, snapshot, std::nullopt);
    samples += observation.sample.has_value();
    events.insert(events.end(), observation.events.begin(), observation.events.end());
  }
  CHECK(samples == 50);
  REQUIRE(events.size() == 2);
  CHECK(events[0].kind == "mirror_glance");
  CHECK(events[0].detail == "area=\"left mirror\" duration_s=0.50");
  CHECK(events[1].kind == "lane_change");
  CHECK(events[1].detail == "lanes_to_left=1 from_lane=-2 to_lane=-1");
}

}  // namespace septet::logging

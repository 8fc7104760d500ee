// Impossible numbers are reported and left out.

#include <sqlite3.h>

#include <algorithm>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "logging/study/report/group_report.hpp"
#include "logging/study/report/report.hpp"
#include "logging/study/report/summary.hpp"
#include "tests/logging/count_of.hpp"
#include "tests/logging/sample_series.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

/// A minute's drive with later alterations.
std::filesystem::path altered_session(const TemporaryFolder& folder, const std::string& sql) {
  const auto file = folder / "session.sqlite";
  SessionWriter writer = must_create(file);
  for (int i = 0; i <= 600; ++i) {
    Sample sample = sample_at(i, -2, 0.1);
    sample.speed_mps = 20.0;
    sample.leader = Leader{5, 50.0, 55.0, 19.0};
    writer.record(sample);
    writer.record(InputRecord{.tick = static_cast<Tick>(12 * i), .report = {}, .input = {.steering_wheel_rad = 0.01}});
  }
  writer.record(QuestionnaireRecord{"paper.fun", "", "4", 4.0, 60.0, false, ""});
  writer.record(Event{120, 1.0, "collision", 3, "tree closing_speed_mps=4.5"});
  REQUIRE(writer.finish().has_value());
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &database) == SQLITE_OK);
  CHECK(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
  return file;
}

/// The longest run of digits in a text.
std::size_t longest_number(const std::string& text) {
  std::size_t longest = 0, now = 0;
  for (const char c : text) longest = std::max(longest, now = c >= '0' && c <= '9' ? now + 1 : 0);
  return longest;
}

}  // namespace

TEST_CASE("no report, summary or table prints a number that nothing physical has, and each says what was left out") {
  const char* alterations[] = {
      "UPDATE samples SET speed_mps=1e300, x_m=1e300, lateral_position_m=1e300",
      "UPDATE samples SET speed_mps=-1e300 WHERE tick > 3000",
      "UPDATE samples SET distance_gap_m=1e300, distance_headway_m=1e300",
      "UPDATE samples SET longitudinal_acceleration_mps2=1e308, steering_wheel_rad=-1e308 WHERE tick % 24 = 0",
      "UPDATE driver_inputs SET steering_wheel_rad=1e300",
      "UPDATE questionnaire SET value=1e300, observed_s=1e300",
      "UPDATE samples SET simulated_time_s=1e300 WHERE tick = 1200"};
  for (const char* sql : alterations) {
    CAPTURE(sql);
    const TemporaryFolder folder;
    const auto file = altered_session(folder, sql);
    const SessionReader reader = must_open(file);
    const auto data = read_report_data(reader);
    REQUIRE(data.has_value());
    const std::string page = to_html(*data);
    CHECK(count_of(page, "nothing physical has") == 1);
    const auto log = summarise_log(reader);
    REQUIRE(log.has_value());
    DriveSummary summary;
    summary.log = *log;
    const std::string json = to_json(summary);
    CHECK(count_of(json, "nothing physical has") == 1);
    auto subjects = pool_sessions(std::vector<std::filesystem::path>{file}, {});
    REQUIRE(subjects.has_value());
    GroupReport report;
    report.subjects = std::move(*subjects);
    const std::string group_page = to_html(report), csv = to_csv(report), group_json = to_json(report);
    CHECK(count_of(group_page, "nothing physical has") == 1);
    for (const std::string& text : {page, json, group_page, csv, group_json}) {
      CHECK(longest_number(text) < 25);
      // Named once in its notice, and nowhere else.
      CHECK(count_of(text, "e+30") <= 1);
    }
  }
}

TEST_CASE("a collision's closing speed that no body has is not known") {
  const TemporaryFolder folder;
  const auto file = altered_session(folder, "UPDATE events SET detail='tree closing_speed_mps=1e300'");
  const auto log = summarise_log(must_open(file));
  REQUIRE(log.has_value());
  DriveSummary summary;
  summary.log = *log;
  const auto json = nlohmann::json::parse(to_json(summary));
  CHECK(json["measures"]["collisions"]["value"] == 1.0);
  CHECK(json["measures"]["collision_closing_speed_largest_mps"]["value"].is_null());
}

TEST_CASE("the hardest crash of a car is a number that can be") {
  const TemporaryFolder folder;
  const auto file = altered_session(
      folder, "UPDATE samples SET speed_mps=120, longitudinal_acceleration_mps2=-4000, steering_wheel_rad=13");
  CHECK_FALSE(read_report_data(must_open(file))->impossible.any());
}

}  // namespace septet::logging

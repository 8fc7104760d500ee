// One person's answers after different drives stay apart, and missing measures are missing.

#include <algorithm>
#include <sstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "logging/session/session_writer.hpp"
#include "logging/study/report/group_report.hpp"
#include "logging/study/report/summary.hpp"
#include "tests/logging/sample_series.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/why_not.hpp"

namespace septet::logging {
namespace {

namespace fs = std::filesystem;

struct OneDrive {
  std::string participant = "P01", part = "bend", condition, order = "1";
  std::vector<QuestionnaireRecord> answers = {};
  double gaze_rad = 0.0;
  std::int32_t lane = -2;
};

fs::path write_part(const fs::path& folder, const OneDrive& drive) {
  SessionInfo info = example_info();
  info.participant = drive.participant;
  info.other = {{"part", drive.part}, {"condition", drive.condition}, {"order", drive.order}};
  fs::path session;
  for (int number = 1; session.empty() || fs::exists(session); ++number)
    session = folder / std::to_string(number) / "session.sqlite";
  fs::create_directories(session.parent_path());
  auto writer = SessionWriter::create(session, info);
  REQUIRE(writer.has_value());
  for (int i = 0; i <= 100; ++i) {
    Sample sample = sample_at(i, drive.lane, 0.0);
    sample.speed_mps = 20.0;
    sample.gaze_heading_rad = i % 50 < 5 ? drive.gaze_rad : 0.0;
    writer->record(sample);
  }
  for (const auto& answer : drive.answers) writer->record(answer);
  REQUIRE(writer->finish().has_value());
  return session;
}

GroupReport report_of(const std::vector<fs::path>& sessions) {
  auto subjects = pool_sessions(sessions, {});
  REQUIRE_MESSAGE(subjects.has_value(), why_not(subjects));
  GroupReport report;
  report.subjects = std::move(*subjects);
  return report;
}

/// The cell of a table without quotes; of no such column the word "no column".
std::string cell_in(const std::string& csv, std::size_t row, const std::string& column) {
  std::istringstream lines(csv);
  std::string head, line;
  std::getline(lines, head);
  for (std::size_t i = 0; i <= row; ++i) std::getline(lines, line);
  std::istringstream names(head), cells(line);
  for (std::string name, cell; std::getline(names, name, ',');) {
    std::getline(cells, cell, ',');
    if (name == column) return cell;
  }
  return "no column";
}

QuestionnaireRecord answer_of(const std::string& item, double value) {
  return {item, "", std::to_string(value), value, 10.0, false, ""};
}

}  // namespace

TEST_CASE("answers after two conditions are two columns and the plain one is empty where they differ") {
  const TemporaryFolder folder;
  const auto report = report_of(
      {write_part(folder.path(), {.condition = "clear",
                                  .order = "1",
                                  .answers = {answer_of("workload.mental", 2), answer_of("workload.effort", 7),
                                              answer_of("age.years", 40)}}),
       write_part(folder.path(), {.condition = "fog",
                                  .order = "2",
                                  .answers = {answer_of("workload.mental", 18), answer_of("workload.effort", 7)}})});
  const std::string csv = to_csv(report);
  INFO(csv);
  CHECK(cell_in(csv, 0, "bend clear.answer.workload.mental") == "2");
  CHECK(cell_in(csv, 0, "bend fog.answer.workload.mental") == "18");
  CHECK(cell_in(csv, 0, "answer.workload.mental") == "");
  CHECK(cell_in(csv, 0, "answer.workload.effort") == "7");  // Both say so.
  CHECK(cell_in(csv, 0, "answer.age.years") == "40");       // Only one has it.
  CHECK(cell_in(csv, 0, "bend fog.answer.age.years") == "no column");
  CHECK(cell_in(csv, 0, "order") == "");
  CHECK(cell_in(csv, 0, "bend fog.order") == "2");
  const auto json = nlohmann::json::parse(to_json(report));
  CHECK(json["version"] == 2);
  CHECK_FALSE(json["subjects"][0]["answers"].contains("workload.mental"));
  CHECK(json["subjects"][0]["drives"][0]["answers"]["workload.mental"] == 2.0);
  CHECK(json["subjects"][0]["drives"][1]["answers"]["workload.mental"] == 18.0);
  const std::string html = to_html(report);
  CHECK(html.find("<td>bend clear</td>") != std::string::npos);
  CHECK(html.find("<td>bend fog</td>") != std::string::npos);
}

TEST_CASE("who dropped out of one condition has not dropped out of the other and playing times stay apart") {
  const TemporaryFolder folder;
  const QuestionnaireRecord sick = {"drive_completed", "", std::nullopt, std::nullopt, 4.0, true, "felt sick"};
  const QuestionnaireRecord played = {"playing_time", "", std::nullopt, std::nullopt, 10.0, true, ""};
  const auto report =
      report_of({write_part(folder.path(), {.condition = "clear", .answers = {played}}),
                 write_part(folder.path(), {.condition = "fog", .answers = {sick}}),
                 write_part(folder.path(), {.participant = "P02", .condition = "clear", .answers = {played}}),
                 write_part(folder.path(), {.participant = "P02", .condition = "fog", .answers = {played}})});
  const std::string csv = to_csv(report);
  INFO(csv);
  CHECK(cell_in(csv, 0, "bend clear.stopped") == "0");
  CHECK(cell_in(csv, 0, "bend fog.stopped") == "1");
  CHECK(cell_in(csv, 0, "bend fog.playing_time_s") == "4");
  CHECK(cell_in(csv, 0, "bend fog.reason") == "felt sick");
  CHECK(cell_in(csv, 0, "stopped") == "");
  CHECK(cell_in(csv, 1, "stopped") == "0");
  CHECK(cell_in(csv, 1, "playing_time_s") == "10");
  const std::string html = to_html(report);
  CHECK(html.find("Playing time: bend clear") != std::string::npos);
  CHECK(html.find("Playing time: bend fog") != std::string::npos);
  CHECK(html.find("1 of 4") != std::string::npos);  // Stopped of their own will.
}

TEST_CASE("rows of a table have as many cells as its head whoever lacks a drive or an answer") {
  const TemporaryFolder folder;
  const auto report =
      report_of({write_part(folder.path(), {.condition = "clear", .answers = {answer_of("q.a", 1)}}),
                 write_part(folder.path(), {.condition = "fog", .answers = {answer_of("q.a", 2), answer_of("q.b", 3)}}),
                 write_part(folder.path(), {.participant = "P02", .condition = "fog"}),
                 write_part(folder.path(), {.participant = "P03", .part = "", .answers = {answer_of("q.a", 4)}})});
  std::istringstream lines(to_csv(report));
  std::string head, line;
  std::getline(lines, head);
  CHECK(head.find("no part.answer.q.a") != std::string::npos);
  int rows = 0;
  for (; std::getline(lines, line); ++rows)
    CHECK(std::count(line.begin(), line.end(), ',') == std::count(head.begin(), head.end(), ','));
  CHECK(rows == 3);
}

TEST_CASE("a code that a spreadsheet takes for something else is in the table whole") {
  const TemporaryFolder folder;
  std::vector<fs::path> sessions;
  for (const char* code : {"'07", "007", "=1+1", "NA", "null"})
    sessions.push_back(write_part(folder.path(), {.participant = code}));
  const std::string csv = to_csv(report_of(sessions));
  // Without the first apostrophe, each is the given text.
  const char* cells[] = {"''07", "007", "'=1+1", "NA", "null"};
  for (std::size_t row = 0; row < 5; ++row) CHECK(cell_in(csv, row, "participant") == cells[row]);
}

TEST_CASE("without a head tracker glances are missing and not none, without a lane its changes") {
  const TemporaryFolder folder;
  const auto report = report_of({write_part(folder.path(), {.participant = "A", .gaze_rad = 0.7}),
                                 write_part(folder.path(), {.participant = "B"}),
                                 write_part(folder.path(), {.participant = "C", .gaze_rad = 0.1, .lane = 0})});
  const std::string csv = to_csv(report);
  CHECK(cell_in(csv, 0, "bend.mirror_glances") == "2");
  CHECK(cell_in(csv, 1, "bend.mirror_glances") == "");
  CHECK(cell_in(csv, 2, "bend.mirror_glances") == "0");  // It moved, and met no mirror.
  CHECK(cell_in(csv, 1, "bend.lane_changes") == "0");
  CHECK(cell_in(csv, 2, "bend.lane_changes") == "");
  const auto json = nlohmann::json::parse(to_json(report));
  const auto& glances = json["subjects"][1]["drives"][0]["measures"]["mirror_glances"];
  CHECK(glances["value"].is_null());
  CHECK(glances["samples"] == 0);
  CHECK(glances["missing"] == 101);
  // The page's row beside the paper divides by the time of drives with a known head alone: 2 × 10 s over 2.
  CHECK(to_html(report).find("<td class=\"value\">10.0 s</td>") != std::string::npos);
}

TEST_CASE("a session without samples has no figure that is 0") {
  const TemporaryFolder folder;
  const auto file = folder / "session.sqlite";
  REQUIRE(must_create(file).finish().has_value());
  const auto log = summarise_log(must_open(file));
  REQUIRE(log.has_value());
  DriveSummary summary;
  summary.log = *log;
  const auto json = nlohmann::json::parse(to_json(summary));
  for (const auto& measure : json["measures"].items()) CHECK_MESSAGE(measure.value()["value"].is_null(), measure.key());
  for (const char* key : {"distance_m", "lane_changes", "mirror_glances"}) CHECK_MESSAGE(json[key].is_null(), key);
  CHECK(json["speed_mps"]["mean"].is_null());
  CHECK(json["time_headway_s"]["following_s"].is_null());
}

}  // namespace septet::logging

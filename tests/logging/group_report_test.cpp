#include "logging/study/report/group_report.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "logging/session/session_writer.hpp"
#include "tests/logging/sample_series.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

/// A drive of `seconds` at this speed, drifting from one side to the other.
void write_drive(const std::filesystem::path& path, const std::string& participant, const std::string& group,
                 double speed_mps, int seconds, const std::vector<QuestionnaireRecord>& answers = {}) {
  SessionInfo info = example_info();
  info.participant = participant;
  info.other["group"] = group;
  info.other["part"] = "game";
  std::filesystem::create_directories(path.parent_path());
  auto writer = SessionWriter::create(path, info);
  REQUIRE(writer.has_value());
  for (int i = 0; i <= seconds * 10; ++i) {
    Sample sample = sample_at(i, -2, 0.2 * std::sin(0.05 * i));
    sample.speed_mps = speed_mps;
    writer->record(sample);
  }
  for (const auto& answer : answers) writer->record(answer);
  REQUIRE(writer->finish().has_value());
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("drives of a participant are measured as one and nothing runs across from one to the next") {
  const TemporaryFolder folder;
  write_drive(folder / "a/1/session.sqlite", "P01", "novice", 20.0, 30);
  write_drive(folder / "a/2/session.sqlite", "P01", "novice", 30.0, 60);
  const std::vector<std::filesystem::path> sessions{folder / "a/1/session.sqlite", folder / "a/2/session.sqlite"};
  const auto subjects = pool_sessions(sessions, {});
  REQUIRE_MESSAGE(subjects.has_value(), subjects.error().what);
  REQUIRE(subjects->size() == 1);
  REQUIRE(subjects->front().drives.size() == 1);
  const DriveMeasures& measures = subjects->front().drives.front().measures;
  CHECK(measures.samples == 301 + 601);
  CHECK(measures.duration_s == doctest::Approx(90.0));
  CHECK(measures.distance_m == doctest::Approx(20.0 * 30 + 30.0 * 60));
  CHECK(measures.tlc.missing == 4);  // Both ends of both.
  CHECK(measures.lane_changes.empty());
  CHECK(subjects->front().drives.front().label == "game");
}

TEST_CASE(
    "the table has a row for each subject and an empty cell where a value is undefined and texts that stay texts") {
  const TemporaryFolder folder;
  write_drive(
      folder / "1/session.sqlite", "P01", "=cmd,\"x\"", 20.0, 30,
      {{"paper.fun", "", "5", 5.0, 30.0, false, ""}, {"playing_time", "", std::nullopt, 30.0, 30.0, false, "bored"}});
  write_drive(folder / "2/session.sqlite", "P02", "experienced", 25.0, 30,
              {{"playing_time", "", std::nullopt, std::nullopt, 30.0, true, ""}});
  const auto subjects =
      pool_sessions(std::vector<std::filesystem::path>{folder / "1/session.sqlite", folder / "2/session.sqlite"}, {});
  REQUIRE(subjects.has_value());
  GroupReport report;
  report.subjects = *subjects;
  const auto lines = lines_of(to_csv(report));
  REQUIRE(lines.size() == 3);
  CHECK(lines[0].starts_with(
      "participant,group,driver,order,playing_time_s,stopped,reason,answer.paper.fun,game.drives,game.seeds"));
  CHECK(lines[1].starts_with("P01,\"'=cmd,\"\"x\"\"\",,,30,1,bored,5,1,"));
  CHECK(lines[2].starts_with("P02,experienced,,,30,0,,,1,"));
  CHECK(std::ranges::count(lines[0], ',') == std::ranges::count(lines[2], ','));
  const auto json = nlohmann::json::parse(to_json(report));
  CHECK(json["subjects"][0]["answers"]["paper.fun"] == 5.0);
  CHECK(json["subjects"][1]["stopped"] == false);
  const auto& ttc = json["subjects"][0]["drives"][0]["measures"]["ttc_smallest_s"];
  CHECK(ttc["value"].is_null());  // No leader.
  CHECK(ttc["missing"] == 301);
  CHECK(json["measures"]["ttc_smallest_s"]["unit"] == "s");
}

TEST_CASE(
    "the group's page has figure 5 and the survival curve and each difference with its test's name and escapes names") {
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> sessions;
  for (int i = 0; i < 6; ++i) {
    sessions.push_back(folder / std::to_string(i) / "session.sqlite");
    write_drive(sessions.back(), "P0" + std::to_string(i), i < 3 ? "<novice>" : "experienced", 20.0 + i, 20 + i,
                {{"playing_time", "", std::nullopt, std::nullopt, 60.0 * (20 + i), i % 2 == 0, ""}});
  }
  const auto subjects = pool_sessions(sessions, {});
  REQUIRE(subjects.has_value());
  GroupReport report;
  report.subjects = *subjects;
  const std::string html = to_html(report);
  const auto count = [&](const std::string& part) {
    int found = 0;
    for (auto at = html.find(part); at != std::string::npos; at = html.find(part, at + 1)) ++found;
    return found;
  };
  CHECK(count("<rect class=\"bar") == 21);
  CHECK(count("Who is still driving") > 0);
  CHECK(count("413 973") == 1);
  CHECK(count("log-rank") == 1);
  CHECK(count("Hedges") > 0);
  CHECK(count("Mann–Whitney") > 0);
  CHECK(count("<novice>") == 0);
  CHECK(count("http") == 0);
  CHECK(count("simulated drivers") == 0);  // People, as far as these sessions say.
}

TEST_CASE("without a session that can be read there is an error and of no subject a page all the same") {
  const TemporaryFolder folder;
  CHECK_FALSE(pool_sessions(std::vector<std::filesystem::path>{folder / "none.sqlite"}, {}).has_value());
  CHECK(to_html(GroupReport{}).find("0 drivers") != std::string::npos);
  CHECK(lines_of(to_csv(GroupReport{})).size() == 1);
}

}  // namespace septet::logging

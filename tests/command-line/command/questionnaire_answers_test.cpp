#include "command-line/command/questionnaire_answers.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "engine/core/regular_file.hpp"
#include "engine/document/json.hpp"
#include "engine/document/text_file.hpp"
#include "logging/session/session_reader.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::server {

TEST_CASE("answers from the page lie in the session, and what cannot be is refused and changes nothing") {
  const TemporaryFolder folder;
  const auto session = folder / "session.sqlite";
  REQUIRE(logging::SessionWriter::create(session, logging::example_info())->finish().has_value());
  const auto questionnaires = find_questionnaires();
  REQUIRE(questionnaires.has_value());
  CHECK(std::ranges::none_of(*questionnaires, [](const auto& one) { return one.id == "misc"; }));
  const page::Answer good{
      .session = 1, .questionnaire = "paper", .as = "paper-after", .answers = {{"fun", 5}, {"realistic", 3}}};
  const auto rows = [&] { return logging::SessionReader::open(session)->questionnaire().value(); };
  for (const auto& spoil : std::vector<void (*)(page::Answer&)>{
           [](page::Answer& answer) { answer.questionnaire = "../questionnaires/paper"; },
           [](page::Answer& answer) { answer.questionnaire = "misc"; },
           [](page::Answer& answer) { answer.questionnaire.clear(); }, [](page::Answer& answer) { answer.as = "../x"; },
           [](page::Answer& answer) { answer.as = "a.b"; }, [](page::Answer& answer) { answer.as = "misc"; },
           [](page::Answer& answer) { answer.as = "ssq"; },
           [](page::Answer& answer) { answer.as = std::string(61, 'a'); },
           [](page::Answer& answer) { answer.answers.clear(); },
           [](page::Answer& answer) { answer.answers[0].first = "joy"; },
           [](page::Answer& answer) { answer.answers[0].second = 0; },
           [](page::Answer& answer) { answer.answers[0].second = 6; },
           [](page::Answer& answer) { answer.answers[0].second.reset(); }}) {
    page::Answer spoiled = good;
    spoil(spoiled);
    CHECK(keep_answers(*questionnaires, spoiled, session).has_value());
  }
  CHECK(rows().empty());
  CHECK(keep_answers(*questionnaires, good, folder / "none.sqlite").has_value());
  CHECK_FALSE(keep_answers(*questionnaires, good, session).has_value());
  REQUIRE(rows().size() == 2);
  CHECK(rows()[0].item == "paper-after.fun");
  CHECK(rows()[0].value == 5.0);
  // New answers replace them, and omitted items are kept as unanswered.
  page::Answer again = good;
  again.answers = {{"realistic", 1}};
  CHECK_FALSE(keep_answers(*questionnaires, again, session).has_value());
  REQUIRE(rows().size() == 2);
  CHECK_FALSE(rows()[0].value.has_value());
  CHECK(rows()[1].value == 1.0);
}

TEST_CASE("answers from the page stand in the summary that lies beside the session, too") {
  const TemporaryFolder folder;
  const auto session = folder / "session.sqlite", summary = folder / "summary.json";
  REQUIRE(logging::SessionWriter::create(session, logging::example_info())->finish().has_value());
  REQUIRE(document::write_text_file(summary, "{\"answers\": {}, \"seed\": 7}").has_value());
  const auto questionnaires = find_questionnaires();
  REQUIRE(questionnaires.has_value());
  const page::Answer answer{.session = 1, .questionnaire = "paper", .as = "paper-after", .answers = {{"fun", 5}}};
  CHECK_FALSE(keep_answers(*questionnaires, answer, session).has_value());
  const auto renewed = document::Json::parse(read_regular_file(summary).value());
  CHECK(renewed["seed"] == 7);
  CHECK(renewed["answers"].dump().find("paper-after.fun") != std::string::npos);
}

}  // namespace septet::server

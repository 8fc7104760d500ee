#include "logging/study/questionnaire.hpp"

#include <algorithm>
#include <fstream>

#include <doctest/doctest.h>

#include "engine/core/regular_file.hpp"
#include "tests/checkout.hpp"

namespace septet::logging {
namespace {

Questionnaire shipped(const std::string& name) {
  const std::string file = source_folder() + "/scenarios/questionnaires/" + name + ".toml";
  const auto text = read_regular_file(file);
  REQUIRE(text.has_value());
  const auto questionnaire = read_questionnaire(*text, file);
  REQUIRE_MESSAGE(questionnaire.has_value(), questionnaire.error().what);
  return *questionnaire;
}

}  // namespace

TEST_CASE("the sickness questionnaire scores Kennedy's largest values and counts nausea in two scores") {
  const Questionnaire ssq = shipped("ssq");
  REQUIRE(ssq.items.size() == 16);
  std::size_t loadings = 0;
  for (const auto& score : ssq.scores) loadings += score.items.size();
  CHECK(loadings == 21);
  Answers all;
  for (const auto& item : ssq.items) all[item.id] = 3;
  auto scores = scores_of(ssq, all);
  CHECK(scores["score_nausea"].value() == doctest::Approx(200.34));
  CHECK(scores["score_oculomotor"].value() == doctest::Approx(159.18));
  CHECK(scores["score_disorientation"].value() == doctest::Approx(292.32));
  CHECK(scores["score_total"].value() == doctest::Approx(235.62));
  Answers sick;
  for (const auto& item : ssq.items) sick[item.id] = item.id == "nausea" ? 2 : 0;
  scores = scores_of(ssq, sick);
  CHECK(scores["score_nausea"].value() == doctest::Approx(2 * 9.54));
  CHECK(scores["score_oculomotor"].value() == 0.0);
  CHECK(scores["score_disorientation"].value() == doctest::Approx(2 * 13.92));
  CHECK(scores["score_total"].value() == doctest::Approx(4 * 3.74));
}

TEST_CASE("an item without an answer leaves its scores without a value and the others with theirs") {
  const Questionnaire ssq = shipped("ssq");
  Answers answers;
  for (const auto& item : ssq.items)
    if (item.id != "vertigo") answers[item.id] = 1;
  auto scores = scores_of(ssq, answers);
  CHECK(scores["score_nausea"].has_value());
  CHECK_FALSE(scores["score_disorientation"].has_value());
  CHECK_FALSE(scores["score_total"].has_value());
  const auto records = records_of(ssq, answers, "ssq-after", 12.5);
  CHECK(records.size() == 20);
  const auto vertigo = std::ranges::find(records, "ssq-after.vertigo", &QuestionnaireRecord::item);
  REQUIRE(vertigo != records.end());
  CHECK_FALSE(vertigo->value.has_value());
  CHECK(records.front().answer == "slight");
}

TEST_CASE("answers are whole numbers of the item's scale and name items that there are") {
  const Questionnaire paper = shipped("paper");
  const auto answers = read_answers(paper, "fun = 5\nrealistic = 3\n", "P01.toml");
  REQUIRE(answers.has_value());
  CHECK(answers->at("fun") == 5);
  for (const char* wrong :
       {"fun = 6", "fun = 0", "fun = 4.0", "fun = \"4\"", "funny = 4", "[fun]\nx = 1", "fun = 99999999999"}) {
    const auto refused = read_answers(paper, wrong, "P01.toml");
    REQUIRE_FALSE_MESSAGE(refused.has_value(), wrong);
    CHECK(refused.error().where.starts_with("P01.toml:"));
  }
  CHECK(read_answer_text(paper.items[0], " 4 \n").value() == 4);
  CHECK_FALSE(read_answer_text(paper.items[0], "four").has_value());
}

TEST_CASE("a questionnaire that makes no sense is refused by line") {
  for (const char* wrong :
       {"id = \"q\"", "id = \"q q\"\n[[item]]\nid = \"a\"\ntext = \"A\"", "id = \"q\"\n[[item]]\nid = \"a\"",
        "id = \"q\"\n[[item]]\nid = \"a\"\ntext = \"A\"\nleast = 5\nmost = 5",
        "id = \"q\"\n[[item]]\nid = \"a\"\ntext = \"A\"\nlabels = [\"one\"]",
        "id = \"q\"\n[[item]]\nid = \"a\"\ntext = \"A\"\nlabels = [1, 2, 3, 4, 5]",
        "id = \"q\"\n[[item]]\nid = \"a\"\ntext = \"A\"\n[[item]]\nid = \"a\"\ntext = \"B\"",
        "id = \"q\"\n[[item]]\nid = \"a\"\ntext = \"A\"\n[[score]]\nid = \"s\"\nitems = [\"b\"]",
        "id = \"q\"\n[[item]]\nid = \"a\"\ntext = \"A\"\n[[score]]\nid = \"s\"\nscores = [\"s\"]",
        "id = \"q\"\nnonsense = 1\n[[item]]\nid = \"a\"\ntext = \"A\""})
    CHECK_FALSE_MESSAGE(read_questionnaire(wrong, "q.toml").has_value(), wrong);
}

}  // namespace septet::logging

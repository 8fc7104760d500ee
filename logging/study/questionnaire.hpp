#pragma once
/// Questionnaires as TOML (docs/experiments.md): items with a scale, scores computed from them, answers and their
/// scores.
///
/// A score is weight · sum of its items, or weight · sum of the unweighted sums of other scores. If one of its items
/// has no answer there is no score: missing answers are not imputed.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

struct QuestionnaireItem {
  std::string id, text;
  int least = 1, most = 5;
  std::vector<std::string> labels;  ///< From least to most; empty, or one per step of the scale.
};

struct QuestionnaireScore {
  std::string id, title;
  std::vector<std::string> items;   ///< Ids; one may be in several scores.
  std::vector<std::string> scores;  ///< Ids of earlier scores, whose sums are added before any weight.
  double weight = 1.0;
};

struct Questionnaire {
  std::string id, title, source;
  std::vector<QuestionnaireItem> items;
  std::vector<QuestionnaireScore> scores;
};

Expected<Questionnaire> read_questionnaire(std::string_view toml, std::string_view name);

using Answers = std::map<std::string, int>;  ///< By item; without unanswered ones.
/// A table ITEM = NUMBER. Error: no such item, a number beyond its scale.
Expected<Answers> read_answers(const Questionnaire& questionnaire, std::string_view toml, std::string_view name);
/// Parses an answer to the item. Error: not on its scale.
Expected<int> read_answer_text(const QuestionnaireItem& item, std::string_view text);

/// Empty if an answer is missing.
std::map<std::string, std::optional<double>> scores_of(const Questionnaire& questionnaire, const Answers& answers);

/// Rows for the session: one for each item, named PREFIX.ITEM, unanswered ones too, and one for each score.
std::vector<QuestionnaireRecord> records_of(const Questionnaire& questionnaire, const Answers& answers,
                                            const std::string& prefix, double observed_s);

/// The row of a participant who stopped before the drive's end: a drop-out, which reports treat as censored.
QuestionnaireRecord drop_out(double observed_s, std::string reason);

}  // namespace septet::logging

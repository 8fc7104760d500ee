#pragma once
/// How the driver feels, asked by the operator each minute of driven time on one scale (MISC: scenarios/questionnaires/misc.toml).
///
/// Each answer is a row of the session's questionnaire, PREFIX.MINUTE with two digits at least ("misc.03"), and minutes without one have a row
/// without a value, if there is an answer at all: who was never asked has none.

#include <map>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/study/questionnaire.hpp"

namespace septet::server {

class DriverRating {
 public:
  /// Of a questionnaire's first item. Error: it has none, or no label for each value.
  static Expected<DriverRating> of(const logging::Questionnaire& questionnaire);

  const std::string& title() const { return title_; }
  const logging::QuestionnaireItem& item() const { return item_; }
  /// The minute of a simulated time, the first being 0.
  static int minute_of(double simulated_s);
  /// The answers so far, by minute.
  const std::map<int, int>& answers() const { return answers_; }

  /// The answer of the minute that goes on. Error: it has one, or the value is beyond the scale.
  Expected<logging::QuestionnaireRecord> answer(double simulated_s, int value);
  /// The rows of the minutes without an answer, from the one after the drive began until the one in which it ended.
  std::vector<logging::QuestionnaireRecord> unanswered(double begun_s, double ended_s) const;

 private:
  DriverRating(std::string prefix, std::string title, logging::QuestionnaireItem item)
      : prefix_(std::move(prefix)), title_(std::move(title)), item_(std::move(item)) {}
  logging::QuestionnaireRecord row(int minute, double simulated_s) const;
  std::string prefix_, title_;
  logging::QuestionnaireItem item_;
  std::map<int, int> answers_;
};

}  // namespace septet::server

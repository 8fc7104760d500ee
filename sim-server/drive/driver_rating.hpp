#pragma once
/// The driver's well-being, which the operator asks for each minute of driven time, on one scale (MISC:
/// scenarios/questionnaires/misc.toml).
///
/// Each answer is a row of the session's questionnaire, PREFIX.MINUTE with at least two digits ("misc.03"). If there is
/// any answer, minutes without one have a row without a value; a driver who was never asked has no rows.

#include <map>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/study/questionnaire.hpp"

namespace septet::server {

class DriverRating {
 public:
  /// Takes the scale of a questionnaire's first item. Error: there is no item, or a value without a label.
  static Expected<DriverRating> of(const logging::Questionnaire& questionnaire);

  const std::string& title() const { return title_; }
  const logging::QuestionnaireItem& item() const { return item_; }
  /// The minute of a simulated time, the first being 0.
  static int minute_of(double simulated_s);
  /// The answers so far, by minute.
  const std::map<int, int>& answers() const { return answers_; }

  /// Records the answer for the current minute. Error: the minute has an answer, or the value is off the scale.
  Expected<logging::QuestionnaireRecord> answer(double simulated_s, int value);
  /// Rows of the minutes without an answer, from the one after the drive's beginning to the one of its end.
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

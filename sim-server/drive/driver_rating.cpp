#include "sim-server/drive/driver_rating.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace septet::server {

Expected<DriverRating> DriverRating::of(const logging::Questionnaire& questionnaire) {
  if (questionnaire.items.empty() || questionnaire.items.front().labels.empty())
    return failure("it has no item with a label for each value", questionnaire.id, "give its first item labels");
  return DriverRating(questionnaire.id, questionnaire.title, questionnaire.items.front());
}

int DriverRating::minute_of(double simulated_s) {
  return static_cast<int>(std::clamp(std::floor(simulated_s / 60.0), 0.0, 1e6));
}

logging::QuestionnaireRecord DriverRating::row(int minute, double simulated_s) const {
  return {.item = fmt::format("{}.{:02}", prefix_, minute), .question = item_.text, .observed_s = simulated_s};
}

Expected<logging::QuestionnaireRecord> DriverRating::answer(double simulated_s, int value) {
  if (value < item_.least || value > item_.most)
    return failure(fmt::format("the scale is from {} to {}", item_.least, item_.most), title_,
                   "choose one of its values");
  const int minute = minute_of(simulated_s);
  if (!answers_.try_emplace(minute, value).second)
    return failure(fmt::format("minute {} has its answer", minute), title_, "mark what is to be added with a note");
  auto record = row(minute, simulated_s);
  record.answer = item_.labels[static_cast<std::size_t>(value - item_.least)];
  record.value = value;
  return record;
}

std::vector<logging::QuestionnaireRecord> DriverRating::unanswered(double begun_s, double ended_s) const {
  std::vector<logging::QuestionnaireRecord> rows;
  if (answers_.empty()) return rows;
  for (int minute = minute_of(begun_s) + 1; minute <= minute_of(ended_s); ++minute)
    if (!answers_.contains(minute)) rows.push_back(row(minute, 60.0 * minute));
  return rows;
}

}  // namespace septet::server

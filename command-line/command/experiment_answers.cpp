#include "command-line/command/experiment_answers.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>

#include "logging/session/session_reader.hpp"

namespace septet::server {
namespace fs = std::filesystem;
using logging::PlannedDrive, logging::PlannedSubject;

std::vector<MissingAnswers> missing_answers(const Study& study, const PlannedSubject& subject, const Stand& stand) {
  // Answered questionnaires of each session, by id.
  std::vector<std::set<std::string>> answered;
  for (const fs::path& session : stand.sessions) {
    auto& ids = answered.emplace_back();
    const auto reader = logging::SessionReader::open(session);
    const auto answers = reader ? reader->questionnaire() : Expected<std::vector<logging::QuestionnaireRecord>>();
    if (!answers) continue;
    for (const auto& answer : *answers) ids.insert(answer.item.substr(0, answer.item.find('.')));
  }
  std::vector<MissingAnswers> missing;
  const auto look = [&](const DueQuestionnaire& due, const std::string& condition, const auto& belongs) {
    std::optional<std::size_t> last;
    for (std::size_t i = 0; i < stand.sessions.size(); ++i) {
      if (!belongs(subject.drives[stand.drive_of_session[i]])) continue;
      if (answered[i].contains(due.id)) return;
      last = i;
    }
    if (last) missing.push_back({due.name, condition, stand.sessions[*last]});
  };
  for (const DueQuestionnaire& due : study.questionnaires) {
    if (!due.is_after_each_condition) {
      if (stand.is_finished) look(due, "", [](const PlannedDrive&) { return true; });
      continue;
    }
    for (std::size_t condition = 0; condition < study.experiment.conditions.size(); ++condition) {
      const auto is_of_it = [&](const PlannedDrive& drive) { return drive.condition == condition; };
      // A condition's questionnaire is not due while any of its drives is still missing.
      const bool is_over =
          stand.is_finished || std::none_of(subject.drives.begin() + static_cast<std::ptrdiff_t>(stand.drive),
                                            subject.drives.end(), is_of_it);
      if (is_over) look(due, study.experiment.conditions[condition].name, is_of_it);
    }
  }
  return missing;
}

}  // namespace septet::server

#include "command-line/command/questionnaire_answers.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "command-line/command/list_command.hpp"
#include "command-line/command/renewed_results.hpp"
#include "engine/core/regular_file.hpp"
#include "logging/session/session_editor.hpp"
#include "logging/session/session_reader.hpp"
#include "program/resources.hpp"

namespace septet::server {
namespace {

constexpr const char* questionnaires_folder = "scenarios/questionnaires";
constexpr std::string_view each_minute = "misc";
constexpr std::size_t most_name_characters = 60;

bool is_plain_word(std::string_view word) {
  return !word.empty() && word.size() <= most_name_characters && std::ranges::all_of(word, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

/// Answers to the items, checked. Error: the reason for a refusal.
tl::expected<logging::Answers, std::string> judge_answers(const logging::Questionnaire& questionnaire,
                                                          const page::Answer& answer) {
  logging::Answers answers;
  for (const auto& [id, value] : answer.answers) {
    const auto item = std::ranges::find(questionnaire.items, id, &logging::QuestionnaireItem::id);
    if (item == questionnaire.items.end()) return tl::unexpected(fmt::format("it has no item \"{}\"", id));
    if (!value || *value < item->least || *value > item->most)
      return tl::unexpected(fmt::format("\"{}\" is answered from {} to {}", id, item->least, item->most));
    answers[id] = *value;
  }
  if (answers.empty()) return tl::unexpected(std::string("nothing is answered"));
  return answers;
}

}  // namespace

Expected<std::vector<logging::Questionnaire>> find_questionnaires() {
  const auto listed = list_of(questionnaires_folder);
  if (!listed) return tl::unexpected(listed.error());
  std::vector<logging::Questionnaire> questionnaires;
  for (const ListEntry& entry : *listed) {
    if (entry.name == each_minute) continue;
    const auto file = program::find_resource(entry.name, questionnaires_folder, ".toml");
    if (!file) return tl::unexpected(file.error());
    const auto text = read_regular_file(*file);
    if (!text) return tl::unexpected(text.error());
    auto questionnaire = logging::read_questionnaire(*text, file->string());
    if (!questionnaire) return tl::unexpected(questionnaire.error());
    questionnaires.push_back(std::move(*questionnaire));
  }
  return questionnaires;
}

std::vector<page::QuestionnaireChoice> choices_of(const std::vector<logging::Questionnaire>& questionnaires) {
  std::vector<page::QuestionnaireChoice> choices;
  for (const auto& questionnaire : questionnaires) {
    page::QuestionnaireChoice choice{{questionnaire.id, questionnaire.title}, {}};
    for (const auto& item : questionnaire.items)
      choice.items.push_back({item.id, item.text, item.least, item.most, item.labels});
    choices.push_back(std::move(choice));
  }
  return choices;
}

std::optional<std::string> keep_answers(const std::vector<logging::Questionnaire>& questionnaires,
                                        const page::Answer& answer, const std::filesystem::path& session) {
  const auto questionnaire = std::ranges::find(questionnaires, answer.questionnaire, &logging::Questionnaire::id);
  if (questionnaire == questionnaires.end()) return "there is no such questionnaire";
  const std::string as = answer.as.empty() ? questionnaire->id : answer.as;
  if (!is_plain_word(as))
    return fmt::format("the answers' name is a word of at most {} letters, digits, - and _", most_name_characters);
  const bool is_anothers =
      as != questionnaire->id &&
      (as == each_minute || std::ranges::find(questionnaires, as, &logging::Questionnaire::id) != questionnaires.end());
  if (is_anothers) return "another questionnaire's answers have that name";
  const auto answers = judge_answers(*questionnaire, answer);
  if (!answers) return answers.error();
  const auto reader = logging::SessionReader::open(session);
  if (!reader) return describe(reader.error());
  const auto samples = reader->samples();
  if (!samples) return describe(samples.error());
  const double observed_s = samples->empty() ? 0.0 : samples->back().simulated_time_s;
  const auto added =
      logging::add_answers(session, logging::records_of(*questionnaire, *answers, as, observed_s), as + '.');
  if (!added) return describe(added.error());
  if (const auto renewed = renew_results(session.parent_path(), session); !renewed) return describe(renewed.error());
  return std::nullopt;
}

}  // namespace septet::server

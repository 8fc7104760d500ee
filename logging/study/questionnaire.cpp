#include "logging/study/questionnaire.hpp"

#include <algorithm>
#include <set>

#include <utility>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "engine/core/printable.hpp"
#include "engine/document/table_line.hpp"
#include "engine/document/table_reader.hpp"
#include "engine/document/toml_table.hpp"
#include "logging/study/experiments_document.hpp"

namespace septet::logging {
namespace {

using document::TableReader;

constexpr std::int64_t largest = 1000;

std::vector<std::string> read_texts(const toml::table& table, TableReader& reader, std::string_view key) {
  // The reader knows scalars and tables; lists of texts are few.
  std::vector<std::string> texts;
  const toml::array* array = table.get_as<toml::array>(key);
  if (!array) {
    if (table.contains(key))
      reader.report(key, fmt::format("{} is no list", key), "write a list of texts: [\"…\", \"…\"]");
    return texts;
  }
  for (const toml::node& node : *array) {
    const auto text = node.value<std::string>();
    if (!text) reader.report(key, fmt::format("{} holds something else than a text", key), "put each entry in quotes");
    texts.push_back(text.value_or(""));
  }
  return texts;
}

bool is_id(const std::string& id) {
  return !id.empty() && id.size() <= 60 &&
         id.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string::npos;
}

std::string read_id(TableReader& reader, std::set<std::string>& taken) {
  const std::string id = reader.get_string("id", "");
  if (!is_id(id))
    reader.report("id", fmt::format("the id is \"{}\"", printable(id, 60)), "use letters, digits, _ and -");
  else if (!taken.insert(id).second)
    reader.report("id", fmt::format("there are two \"{}\"", id), "give each an id of its own");
  return id;
}

/// A table's array, taken from the reader's known keys: toml++ has no view without a key.
toml::table without(const toml::table& table, std::initializer_list<std::string_view> keys) {
  toml::table rest = table;
  for (const auto key : keys) rest.erase(key);
  return rest;
}

QuestionnaireItem read_item(const toml::table& table, std::string_view file, std::set<std::string>& taken,
                            Error& error) {
  const toml::table rest = without(table, {"labels"});
  TableReader reader(rest, file, "item", error);
  QuestionnaireItem item;
  item.id = read_id(reader, taken);
  item.text = reader.get_string("text", "");
  item.least = static_cast<int>(reader.get_integer("least", 1, -largest, largest));
  item.most = static_cast<int>(reader.get_integer("most", 5, -largest, largest));
  item.labels = read_texts(table, reader, "labels");
  if (!printable_characters(item.text) || item.text.empty())
    reader.report("text", "an item asks nothing", "give its text, on one line");
  if (item.most <= item.least) reader.report("most", "the scale has no two numbers", "make most larger than least");
  if (!item.labels.empty() && static_cast<int>(item.labels.size()) != item.most - item.least + 1)
    reader.report("least", fmt::format("{} labels for {} numbers", item.labels.size(), item.most - item.least + 1),
                  "give one label for each number of the scale, or none");
  reader.finish(experiments_document);
  return item;
}

QuestionnaireScore read_score(const toml::table& table, std::string_view file, const Questionnaire& so_far,
                              std::set<std::string>& taken, Error& error) {
  const toml::table rest = without(table, {"items", "scores"});
  TableReader reader(rest, file, "score", error);
  QuestionnaireScore score;
  score.id = read_id(reader, taken);
  score.title = reader.get_string("title", score.id);
  score.weight = reader.get_double("weight", 1.0, -1e6, 1e6);
  score.items = read_texts(table, reader, "items");
  score.scores = read_texts(table, reader, "scores");
  for (const auto& id : score.items)
    if (std::ranges::find(so_far.items, id, &QuestionnaireItem::id) == so_far.items.end())
      reader.report("id", fmt::format("there is no item \"{}\"", printable(id, 60)), "name items of this file");
  for (const auto& id : score.scores)
    if (std::ranges::find(so_far.scores, id, &QuestionnaireScore::id) == so_far.scores.end())
      reader.report("id", fmt::format("there is no score \"{}\" before this one", printable(id, 60)),
                    "name scores that stand above it");
  if (score.items.empty() && score.scores.empty())
    reader.report("id", "the score is made of nothing", "list its items");
  reader.finish(experiments_document);
  return score;
}

}  // namespace

Expected<Questionnaire> read_questionnaire(std::string_view text, std::string_view name) {
  const auto table = document::parse_toml(text, name);
  if (!table) return tl::unexpected(table.error());
  Error error;
  TableReader reader(*table, name, "questionnaire", error);
  Questionnaire questionnaire;
  std::set<std::string> taken;
  questionnaire.id = read_id(reader, taken);
  questionnaire.title = reader.get_string("title", questionnaire.id);
  questionnaire.source = reader.get_string("source", "");
  for (const toml::table* item : reader.get_tables("item"))
    questionnaire.items.push_back(read_item(*item, name, taken, error));
  if (questionnaire.items.empty()) reader.report("item", "the questionnaire asks nothing", "add an [[item]]");
  for (const toml::table* score : reader.get_tables("score"))
    questionnaire.scores.push_back(read_score(*score, name, questionnaire, taken, error));
  reader.finish(experiments_document);
  if (!error.what.empty()) return tl::unexpected(error);
  return questionnaire;
}

Expected<int> read_answer_text(const QuestionnaireItem& item, std::string_view text) {
  const auto number = document::number_in<int>(document::trimmed(text));
  if (number && *number >= item.least && *number <= item.most) return *number;
  return failure(fmt::format("\"{}\" is no answer to \"{}\"", printable(text, 60), item.text), item.id,
                 fmt::format("give a whole number from {} to {}", item.least, item.most));
}

Expected<Answers> read_answers(const Questionnaire& questionnaire, std::string_view text, std::string_view name) {
  const auto table = document::parse_toml(text, name);
  if (!table) return tl::unexpected(table.error());
  Answers answers;
  for (const auto& [key, node] : *table) {
    const auto item = std::ranges::find(questionnaire.items, key.str(), &QuestionnaireItem::id);
    const std::string place = document::place_of(node, name);
    if (item == questionnaire.items.end())
      return failure(fmt::format("questionnaire {} has no item \"{}\"", questionnaire.id, printable(key.str(), 60)),
                     place, "write ITEM = NUMBER with the ids of its items");
    const auto number = node.is_integer() ? node.value<std::int64_t>() : std::nullopt;
    if (!number || *number < item->least || *number > item->most)
      return failure(fmt::format("the answer to {} is beyond its scale", item->id), place,
                     fmt::format("give a whole number from {} to {}", item->least, item->most));
    answers[item->id] = static_cast<int>(*number);
  }
  return answers;
}

std::map<std::string, std::optional<double>> scores_of(const Questionnaire& questionnaire, const Answers& answers) {
  std::map<std::string, std::optional<double>> sums, scores;
  for (const QuestionnaireScore& score : questionnaire.scores) {
    std::optional<double> sum = 0.0;
    for (const auto& id : score.items) {
      const auto answer = answers.find(id);
      sum = sum && answer != answers.end() ? std::optional(*sum + answer->second) : std::nullopt;
    }
    for (const auto& id : score.scores) {
      const auto part = sums[id];
      sum = sum && part ? std::optional(*sum + *part) : std::nullopt;
    }
    sums[score.id] = sum;
    scores[score.id] = sum ? std::optional(*sum * score.weight) : std::nullopt;
  }
  return scores;
}

std::vector<QuestionnaireRecord> records_of(const Questionnaire& questionnaire, const Answers& answers,
                                            const std::string& prefix, double observed_s) {
  std::vector<QuestionnaireRecord> records;
  for (const QuestionnaireItem& item : questionnaire.items) {
    QuestionnaireRecord record{prefix + '.' + item.id, item.text, std::nullopt, std::nullopt, observed_s, false, ""};
    if (const auto answer = answers.find(item.id); answer != answers.end()) {
      record.value = answer->second;
      record.answer = item.labels.empty() ? fmt::format("{}", answer->second)
                                          : item.labels[static_cast<std::size_t>(answer->second - item.least)];
    }
    records.push_back(std::move(record));
  }
  const auto scores = scores_of(questionnaire, answers);
  for (const QuestionnaireScore& score : questionnaire.scores) {
    const auto value = scores.at(score.id);
    records.push_back({prefix + '.' + score.id, "score: " + score.title,
                       value ? std::optional(fmt::format("{:.2f}", *value)) : std::nullopt, value, observed_s, false,
                       ""});
  }
  return records;
}

QuestionnaireRecord drop_out(double observed_s, std::string reason) {
  return {"drive_completed", "", std::nullopt, std::nullopt, observed_s, true, std::move(reason)};
}

}  // namespace septet::logging

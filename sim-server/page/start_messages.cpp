#include "sim-server/page/start_messages.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "engine/document/json.hpp"

namespace septet::page {
namespace {

using document::Json;

std::string words_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json list_of(const std::vector<Choice>& choices) {
  Json list = Json::array();
  for (const Choice& choice : choices) list.push_back({{"name", choice.name}, {"about", choice.about}});
  return list;
}

}  // namespace

std::string start_hello_text(const Choices& choices, std::uint64_t browser) {
  Json scenarios = Json::array();
  for (const ScenarioChoice& scenario : choices.scenarios) {
    Json parameters = Json::array();
    for (const auto& [name, value] : scenario.parameters) parameters.push_back({{"name", name}, {"value", value}});
    scenarios.push_back({{"name", scenario.name}, {"about", scenario.about}, {"parameters", std::move(parameters)}});
  }
  Json questionnaires = Json::array();
  for (const QuestionnaireChoice& questionnaire : choices.questionnaires) {
    Json items = Json::array();
    for (const QuestionnaireItemChoice& item : questionnaire.items)
      items.push_back(
          {{"id", item.id}, {"text", item.text}, {"least", item.least}, {"most", item.most}, {"labels", item.labels}});
    questionnaires.push_back(
        {{"name", questionnaire.name}, {"about", questionnaire.about}, {"items", std::move(items)}});
  }
  return words_of({{"type", "hello"},
                   {"schema", schema},
                   {"you", browser},
                   {"choices",
                    {{"scenarios", std::move(scenarios)},
                     {"rigs", list_of(choices.rigs)},
                     {"drivers", list_of(choices.drivers)},
                     {"vehicles", list_of(choices.vehicles)},
                     {"questionnaires", std::move(questionnaires)}}}});
}

std::string start_state_text(const StartView& view, const std::optional<Commander>& commander, std::size_t browsers) {
  Json sessions = Json::array();
  for (const PastSession& session : view.sessions)
    sessions.push_back({{"id", session.id},
                        {"folder", session.folder},
                        {"started_utc", session.started_utc},
                        {"scenario", session.scenario},
                        {"rig", session.rig},
                        {"driver", session.driver},
                        {"participant", session.participant},
                        {"ended", session.ended},
                        {"simulated_s", document::number(session.simulated_s)},
                        {"has_report", session.has_report},
                        {"has_debrief", session.has_debrief},
                        {"answered", session.answered}});
  Json json = {{"type", "start_state"},
               {"starting", view.is_starting},
               {"command", view.command},
               {"said", view.said},
               {"last", view.last},
               {"failed", view.has_failed},
               {"browsers", browsers},
               {"commander", nullptr},
               {"sessions", std::move(sessions)}};
  if (commander) json["commander"] = {{"browser", commander->browser}, {"name", commander->name}};
  return words_of(json);
}

std::string look_text(std::uint64_t id, const std::string& path) {
  return words_of({{"type", "answer"}, {"id", id}, {"ok", true}, {"path", path}});
}

std::string moved_text() { return words_of({{"type", "moved"}}); }

}  // namespace septet::page

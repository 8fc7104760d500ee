#include "sim-server/page/start_messages.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "engine/document/json.hpp"

namespace septet::page {
namespace {

using document::Json;

Json json_of(const Choice& choice) {
  return {{"name", choice.name}, {"about", choice.about}, {"title", choice.title}, {"own", choice.is_own}};
}

Json list_of(const std::vector<Choice>& choices) {
  Json list = Json::array();
  for (const Choice& choice : choices) list.push_back(json_of(choice));
  return list;
}

Json json_of(const PastSession& session) {
  Json tasks = Json::array();
  for (const PastTask& task : session.tasks)
    tasks.push_back({{"says", task.says},
                     {"mark", task.mark ? document::number(*task.mark) : Json(nullptr)},
                     {"severity", task.severity}});
  Json json = {{"id", session.id},
               {"folder", session.folder},
               {"started_utc", session.started_utc},
               {"scenario", session.scenario},
               {"rig", session.rig},
               {"driver", session.driver},
               {"participant", session.participant},
               {"note", session.note},
               {"ended", session.ended},
               {"simulated_s", document::number(session.simulated_s)},
               {"has_report", session.has_report},
               {"has_debrief", session.has_debrief},
               {"has_film", session.has_film},
               {"answered", session.answered},
               {"lesson", session.lesson},
               {"mark", nullptr},
               {"taken", session.is_taken},
               {"passed", session.is_passed},
               {"tasks", std::move(tasks)},
               {"points", nullptr},
               {"level", session.level}};
  if (session.mark) json["mark"] = document::number(*session.mark);
  if (session.points) json["points"] = document::number(*session.points);
  return json;
}

}  // namespace

std::string start_hello_text(const Choices& choices, std::uint64_t browser) {
  Json scenarios = Json::array();
  for (const ScenarioChoice& scenario : choices.scenarios) {
    Json parameters = Json::array();
    for (const auto& [name, value] : scenario.parameters) parameters.push_back({{"name", name}, {"value", value}});
    Json json = json_of(static_cast<const Choice&>(scenario));
    json["parameters"] = std::move(parameters);
    json["kind"] = scenario.is_lesson ? "lesson" : scenario.is_game ? "game" : "drive";
    scenarios.push_back(std::move(json));
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
  return document::line_of({{"type", "hello"},
                            {"schema", schema},
                            {"you", browser},
                            {"choices",
                             {{"scenarios", std::move(scenarios)},
                              {"rigs", list_of(choices.rigs)},
                              {"drivers", list_of(choices.drivers)},
                              {"vehicles", list_of(choices.vehicles)},
                              {"experiments", list_of(choices.experiments)},
                              {"first_rig", choices.first_rig},
                              {"questionnaires", std::move(questionnaires)}}}});
}

std::string start_state_text(const StartView& view, const std::optional<Commander>& commander, std::size_t browsers) {
  Json sessions = Json::array();
  for (const PastSession& session : view.sessions) sessions.push_back(json_of(session));
  Json json = {{"type", "start_state"},
               {"starting", view.is_starting},
               {"command", view.command},
               {"said", view.said},
               {"last", view.last},
               {"failed", view.has_failed},
               {"browsers", browsers},
               {"commander", nullptr},
               {"sessions", std::move(sessions)},
               {"looking", view.is_looking}};
  json["work"] = nullptr;
  if (view.work)
    json["work"] = {{"session", view.work->session},
                    {"what", view.work->what},
                    {"running", view.work->is_running},
                    {"failed", view.work->has_failed},
                    {"said", view.work->said}};
  if (commander) json["commander"] = {{"browser", commander->browser}, {"name", commander->name}};
  return document::line_of(json);
}

std::string look_text(std::uint64_t id, const std::string& path) {
  return document::line_of({{"type", "answer"}, {"id", id}, {"ok", true}, {"path", path}});
}

std::string moved_text() { return document::line_of({{"type", "moved"}}); }

}  // namespace septet::page

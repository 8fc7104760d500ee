#include <array>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

/// The elements of a storyboard that have a state, from the outermost in; the order in which they are numbered.
constexpr std::array<std::pair<const char*, const char*>, 6> levels{{{"Story", "story"},
                                                                     {"Act", "act"},
                                                                     {"ManeuverGroup", "maneuverGroup"},
                                                                     {"Maneuver", "maneuver"},
                                                                     {"Event", "event"},
                                                                     {"Action", "action"}}};

/// Maneuvers of a group: one of a catalog, then its own.
std::vector<Element> maneuvers_of(Reading& reading, const Element& group) {
  std::vector<Element> found;
  if (const Element maneuver = resolve_catalog_reference(reading, group, {"Maneuver"})) found.push_back(maneuver);
  for (const Element& maneuver : group.children("Maneuver")) found.push_back(with_declared_parameters(maneuver));
  return found;
}

std::vector<Element> children_of_level(Reading& reading, const Element& parent, std::size_t level) {
  if (level == 3) return maneuvers_of(reading, parent);
  std::vector<Element> found = parent.children(levels[level].first);
  if (level == 0) {
    for (Element& story : found) story = with_declared_parameters(story);
  }
  return found;
}

/// Numbers all elements before any trigger is read, because a trigger may name a later one.
void number_elements(Reading& reading, const Element& parent, const std::string& path, std::size_t level) {
  for (const Element& element : children_of_level(reading, parent, level)) {
    const std::string name = (path.empty() ? "" : path + "::") + element.label("name");
    reading.scenario.element_names.push_back(name);
    reading.element_types.emplace_back(levels[level].second);
    if (level + 1 < levels.size()) number_elements(reading, element, name, level + 1);
  }
}

Action read_action(Reading& reading, const Element& element) {
  Action action{element.label("name"), reading.next_element++, {}};
  if (const Element found = element.child("PrivateAction"))
    action.what = read_private_action(reading, found);
  else if (const Element global = element.child("GlobalAction"))
    action.what = read_global_action(reading, global);
  else if (const Element user = element.child("UserDefinedAction"))
    action.what = read_user_defined_action(reading, user);
  else
    element.error("it holds no action", "add <PrivateAction>, <GlobalAction> or <UserDefinedAction>");
  return action;
}

Event read_event(Reading& reading, const Element& element) {
  Event event;
  event.name = element.label("name");
  event.element = reading.next_element++;
  event.priority = element.required_word<EventPriority>("priority",
                                                        {{"overwrite", EventPriority::overwrite},
                                                         {"override", EventPriority::overwrite},
                                                         {"skip", EventPriority::skip},
                                                         {"parallel", EventPriority::parallel}},
                                                        EventPriority::overwrite);
  if (element.has("maximumExecutionCount")) {
    event.maximum_executions = static_cast<std::uint32_t>(element.integer("maximumExecutionCount", 0, 1'000'000));
  }
  for (const Element& action : element.children("Action")) event.actions.push_back(read_action(reading, action));
  if (event.actions.empty()) element.error("it holds no action", "add <Action>");
  event.start = read_trigger(reading, element.child("StartTrigger"));
  return event;
}

Maneuver read_maneuver(Reading& reading, const Element& element) {
  Maneuver maneuver{element.label("name"), reading.next_element++, {}};
  for (const Element& event : element.children("Event")) maneuver.events.push_back(read_event(reading, event));
  return maneuver;
}

ManeuverGroup read_group(Reading& reading, const Element& element) {
  ManeuverGroup group;
  group.name = element.label("name");
  group.element = reading.next_element++;
  if (!element.has("maximumExecutionCount")) {
    element.warning("attribute maximumExecutionCount is missing; 1 is taken",
                    "add maximumExecutionCount=\"1\", or the number that is meant");
  } else {
    group.maximum_executions = static_cast<std::uint32_t>(element.integer("maximumExecutionCount", 0, 1'000'000));
  }
  const Element actors = element.required("Actors");
  group.actors_are_triggering_entities = actors && actors.required_boolean("selectTriggeringEntities", false);
  for (const Element& reference : actors.children("EntityRef")) {
    const EntityIndex entity = read_entity_reference(reading, reference);
    if (entity != no_entity) group.actors.push_back(entity);
  }
  for (const Element& found : maneuvers_of(reading, element)) group.maneuvers.push_back(read_maneuver(reading, found));
  return group;
}

Act read_act(Reading& reading, const Element& element) {
  Act act;
  act.name = element.label("name");
  act.element = reading.next_element++;
  for (const Element& group : element.children("ManeuverGroup")) act.groups.push_back(read_group(reading, group));
  act.start = read_trigger(reading, element.child("StartTrigger"));
  act.stop = read_trigger(reading, element.child("StopTrigger"));
  return act;
}

void read_init(Reading& reading, const Element& actions) {
  const auto add = [&](EntityIndex entity, ActionVariant what, const Element& action) {
    reading.scenario.init.push_back({entity, std::move(what), action.where()});
    reading.init_elements.push_back(action);
  };
  for (const Element& global : actions.children("GlobalAction"))
    add(no_entity, read_global_action(reading, global), global);
  for (const Element& user : actions.children("UserDefinedAction")) {
    ActionVariant what = read_user_defined_action(reading, user);
    if (std::holds_alternative<Call>(what))
      user.error("nobody listens yet when Init is carried out", "call from an event of the storyboard");
    if (std::holds_alternative<OverlookAction>(what))
      user.error("nobody drives yet when Init is carried out", "overlook from an event of the storyboard");
    if (std::holds_alternative<HazardAction>(what))
      user.error("nobody drives yet when Init is carried out", "let a hazard begin in an event of the storyboard");
    add(no_entity, std::move(what), user);
  }
  for (const Element& entry : actions.children("Private")) {
    const EntityIndex entity = read_entity_reference(reading, entry);
    for (const Element& action : entry.children("PrivateAction")) {
      ActionVariant what = read_private_action(reading, action);
      if (entity != no_entity) add(entity, std::move(what), action);
    }
  }
}

}  // namespace

void check_maneuver(Reading& reading, const Element& maneuver) {
  reading.scenario.element_names = {"", maneuver.label("name")};
  reading.element_types = {"storyboard", "maneuver"};
  reading.next_element = 1;
  number_elements(reading, maneuver, "", 4);
  read_maneuver(reading, maneuver);
}

void read_storyboard(Reading& reading, const Element& storyboard) {
  Scenario& scenario = reading.scenario;
  scenario.element_names = {""};
  reading.element_types = {"storyboard"};
  number_elements(reading, storyboard, "", 0);
  scenario.element_count = static_cast<std::uint32_t>(scenario.element_names.size());

  read_init(reading, storyboard.required("Init").required("Actions"));
  for (const Element& found : storyboard.children("Story")) {
    const Element element = with_declared_parameters(found);
    Story story{element.label("name"), reading.next_element++, {}};
    for (const Element& act : element.children("Act")) story.acts.push_back(read_act(reading, act));
    scenario.stories.push_back(std::move(story));
  }
  scenario.stop = read_trigger(reading, storyboard.child("StopTrigger"));
}

}  // namespace septet::scenario

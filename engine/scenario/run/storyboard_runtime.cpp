#include "engine/scenario/run/storyboard_runtime.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/core/check.hpp"
#include "engine/scenario/run/condition_evaluation.hpp"
#include "engine/scenario/run/entity_motion.hpp"
#include "engine/scenario/run/resolve_position.hpp"
#include "engine/scenario/run/start_action.hpp"

namespace septet::scenario {
namespace {

/// Applies `use` to each control that may move an entity.
template <class Use>
void each_control(EntityState& entity, const Use& use) {
  use(entity.speed_control);
  use(entity.lateral_control);
  use(entity.path_control);
}

/// One step of a scenario: all data that it reads and writes.
class Step {
 public:
  Step(const Scenario& scenario, const road::RoadNetwork& network, ScenarioState& state, StepResult& result)
      : scenario_(scenario), network_(network), state_(state), result_(result) {}

  void run_storyboard() {
    if (state_.finished) return;
    if (evaluate(scenario_.stop)) {
      for (const Story& story : scenario_.stories) stop_story(story);
      finish(scenario_.storyboard_element, ElementTransition::stop, ElementStatus::complete);
      for (EntityState& entity : state_.entities) {
        each_control(entity, [](auto& control) { control = {}; });
      }
      state_.finished = true;
      return;
    }
    begin(scenario_.storyboard_element);
    for (const Story& story : scenario_.stories) {
      if (element(story.element).status == ElementStatus::complete) continue;
      begin(story.element);
      for (const Act& act : story.acts) run_act(act);
    }
    start_pending();
    settle();
  }

  /// Empty where it has been started, else the reason why not.
  std::optional<std::string> trigger(ElementIndex wanted) {
    if (state_.finished) return "the storyboard is over";
    for (const Story& story : scenario_.stories)
      for (const Act& act : story.acts) {
        if (act.element == wanted) {
          if (const auto no = why_not_to_start(wanted)) return no;
          start_act(story, act);
          start_pending();
          settle();
          return std::nullopt;
        }
        for (const ManeuverGroup& group : act.groups)
          for (const Maneuver& maneuver : group.maneuvers)
            for (const Event& event : maneuver.events)
              if (event.element == wanted) return trigger_event(story, act, group, maneuver, event);
      }
    return "it is neither an act nor an event";
  }

  void release(EntityState& entity) {
    entity.external = true;
    std::vector<ElementIndex> stopped;
    each_control(entity, [&](auto& control) {
      if (control.active && control.action != no_element) stopped.push_back(control.action);
      control = {};
    });
    for (const ElementIndex action : stopped)
      if (!anybody_follows(action)) finish(action, ElementTransition::stop, ElementStatus::complete);
    settle();
  }

  void move_entities(double dt_s) {
    std::vector<ElementIndex> ended;
    for (EntityIndex i = 0; i < state_.entities.size(); ++i) {
      EntityState& entity = state_.entities[i];
      if (!entity.active || entity.external) continue;
      const bool was_there = entity.at_road_end_s == 0.0;
      if (!move_entity(network_, scenario_, state_, dt_s, i, entity, ended)) result_.reset.push_back(i);
      if (was_there && entity.at_road_end_s > 0.0) result_.left.push_back(i);
    }
    for (const ElementIndex action : ended) end_action(action);
    settle();
  }

 private:
  ElementState& element(ElementIndex index) { return state_.elements[index]; }
  bool evaluate(const Trigger& trigger) { return evaluate_trigger(scenario_, network_, trigger, state_); }
  /// A start trigger that is missing or empty holds at once.
  bool may_start(const Trigger& trigger) { return trigger.groups.empty() || evaluate(trigger); }

  void transit(ElementIndex index, ElementTransition transition, ElementStatus to) {
    ElementState& at = element(index);
    at.initialised = true;
    at.last_transition = transition;
    at.transition_sequence = state_.sequence++;
    at.status = to;
    result_.events.push_back({state_.time_s, index, transition, to});
  }
  void begin(ElementIndex index) {
    if (element(index).status != ElementStatus::standby) return;
    ++element(index).executions;
    transit(index, ElementTransition::start, ElementStatus::running);
  }
  void finish(ElementIndex index, ElementTransition transition, ElementStatus to) {
    if (element(index).status == ElementStatus::running || transition == ElementTransition::stop)
      transit(index, transition, to);
  }

  std::optional<std::string> why_not_to_start(ElementIndex index) {
    switch (element(index).status) {
      case ElementStatus::running:
        return "it is running";
      case ElementStatus::complete:
        return "it is over";
      case ElementStatus::standby:
        break;
    }
    return std::nullopt;
  }
  void start_act(const Story& story, const Act& act) {
    begin(scenario_.storyboard_element);
    begin(story.element);
    begin_act(act);
  }
  void begin_act(const Act& act) {
    begin(act.element);
    for (const ManeuverGroup& group : act.groups) begin_group(group);
  }

  std::optional<std::string> trigger_event(const Story& story, const Act& act, const ManeuverGroup& group,
                                           const Maneuver& maneuver, const Event& event) {
    if (const auto no = why_not_to_start(event.element)) return no;
    const ElementStatus status = element(act.element).status;
    if (status == ElementStatus::complete || group.maximum_executions == 0 || event.maximum_executions == 0 ||
        (status == ElementStatus::running && element(group.element).status != ElementStatus::running))
      return "its act or maneuver group is over";
    if (status == ElementStatus::standby) start_act(story, act);
    if (event.priority == EventPriority::overwrite) stop_others(maneuver, event);
    start_event(group, event);
    start_pending();
    settle();
    return std::nullopt;
  }

  void run_act(const Act& act) {
    ElementState& at = element(act.element);
    at.initialised = true;
    if (at.status == ElementStatus::complete) return;
    if (at.status == ElementStatus::standby) {
      if (!may_start(act.start)) return;
      begin_act(act);
    } else if (evaluate(act.stop)) {
      for (const ManeuverGroup& group : act.groups) stop_group(group);
      finish(act.element, ElementTransition::stop, ElementStatus::complete);
      return;
    }
    for (const ManeuverGroup& group : act.groups) {
      if (element(group.element).status != ElementStatus::running) continue;
      for (const Maneuver& maneuver : group.maneuvers) run_maneuver(group, maneuver);
    }
  }

  void begin_group(const ManeuverGroup& group) {
    if (group.maximum_executions == 0) {
      transit(group.element, ElementTransition::skip, ElementStatus::complete);
      return;
    }
    element(group.element).status = ElementStatus::standby;
    begin(group.element);
    for (const Maneuver& maneuver : group.maneuvers) {
      element(maneuver.element).status = ElementStatus::standby;
      begin(maneuver.element);
      for (const Event& event : maneuver.events) {
        ElementState& at = element(event.element);
        at.initialised = true;
        at.executions = 0;
        at.status = event.maximum_executions == 0 ? ElementStatus::complete : ElementStatus::standby;
        forget_trigger(event.start, state_);
      }
    }
  }

  void run_maneuver(const ManeuverGroup& group, const Maneuver& maneuver) {
    for (const Event& event : maneuver.events) {
      if (element(event.element).status != ElementStatus::standby || !may_start(event.start)) continue;
      const auto runs = [&](const Event& other) {
        return &other != &event && element(other.element).status == ElementStatus::running;
      };
      if (event.priority == EventPriority::skip && std::any_of(maneuver.events.begin(), maneuver.events.end(), runs)) {
        transit(event.element, ElementTransition::skip, ElementStatus::standby);
        continue;
      }
      if (event.priority == EventPriority::overwrite) stop_others(maneuver, event);
      start_event(group, event);
    }
  }

  void stop_others(const Maneuver& maneuver, const Event& event) {
    for (const Event& other : maneuver.events)
      if (&other != &event && element(other.element).status == ElementStatus::running) stop_event(other);
  }

  void start_event(const ManeuverGroup& group, const Event& event) {
    begin(event.element);
    const std::vector<EntityIndex> actors =
        group.actors_are_triggering_entities ? triggering_entities(event) : group.actors;
    for (const Action& action : event.actions) {
      transit(action.element, ElementTransition::start, ElementStatus::running);
      pending_.push_back({&action, actors});
    }
  }

  /// All triggers of a step see the world as it was when the step began; then its actions start.
  void start_pending() {
    for (const PendingAction& pending : pending_) {
      const Action& action = *pending.action;
      if (element(action.element).status != ElementStatus::running) continue;
      const StartedAction started =
          start_action(scenario_, network_, action.what, action.element, pending.actors, state_, result_);
      for (const ElementIndex replaced : started.replaced) {
        finish(replaced, ElementTransition::stop, ElementStatus::complete);
      }
      if (!started.goes_on) {
        finish(action.element, ElementTransition::end, ElementStatus::complete);
      }
    }
    pending_.clear();
  }

  static std::vector<EntityIndex> triggering_entities(const Event& event) {
    std::vector<EntityIndex> found;
    for (const ConditionGroup& group : event.start.groups) {
      for (const Condition& condition : group.conditions) {
        for (const EntityIndex entity : condition.triggering_entities) {
          if (std::find(found.begin(), found.end(), entity) == found.end()) found.push_back(entity);
        }
      }
    }
    return found;
  }

  bool anybody_follows(ElementIndex action) {
    bool follows = false;
    for (EntityState& entity : state_.entities)
      each_control(entity,
                   [&](const auto& control) { follows = follows || (control.active && control.action == action); });
    return follows;
  }

  /// An action of several actors ends with the last of them.
  void end_action(ElementIndex action) {
    if (!anybody_follows(action)) finish(action, ElementTransition::end, ElementStatus::complete);
  }

  void stop_event(const Event& event) {
    for (const Action& action : event.actions) {
      if (element(action.element).status != ElementStatus::running) continue;
      for (EntityState& entity : state_.entities) {
        each_control(entity, [&](auto& control) {
          if (control.action == action.element) control = {};
        });
      }
      finish(action.element, ElementTransition::stop, ElementStatus::complete);
    }
    finish(event.element, ElementTransition::stop, after_execution(event));
  }
  ElementStatus after_execution(const Event& event) {
    return element(event.element).executions < event.maximum_executions ? ElementStatus::standby
                                                                        : ElementStatus::complete;
  }

  void stop_group(const ManeuverGroup& group) {
    for (const Maneuver& maneuver : group.maneuvers) {
      for (const Event& event : maneuver.events) {
        if (element(event.element).status == ElementStatus::running) stop_event(event);
        if (element(event.element).status == ElementStatus::standby)
          transit(event.element, ElementTransition::stop, ElementStatus::complete);
      }
      if (element(maneuver.element).status == ElementStatus::running)
        finish(maneuver.element, ElementTransition::stop, ElementStatus::complete);
    }
    if (element(group.element).status == ElementStatus::running)
      finish(group.element, ElementTransition::stop, ElementStatus::complete);
  }

  void stop_story(const Story& story) {
    for (const Act& act : story.acts) {
      if (element(act.element).status != ElementStatus::running) continue;
      for (const ManeuverGroup& group : act.groups) stop_group(group);
      finish(act.element, ElementTransition::stop, ElementStatus::complete);
    }
    if (element(story.element).status == ElementStatus::running)
      finish(story.element, ElementTransition::stop, ElementStatus::complete);
  }

  bool complete(ElementIndex index) { return element(index).status == ElementStatus::complete; }
  template <class Children>
  bool all_complete(const Children& children) {
    return std::all_of(children.begin(), children.end(), [&](const auto& child) { return complete(child.element); });
  }

  /// Ends elements without anything left to do, from the inside out.
  void settle() {
    for (const Story& story : scenario_.stories) {
      for (const Act& act : story.acts) {
        if (element(act.element).status != ElementStatus::running) continue;
        for (const ManeuverGroup& group : act.groups) settle_group(group);
        if (all_complete(act.groups)) finish(act.element, ElementTransition::end, ElementStatus::complete);
      }
      if (all_complete(story.acts)) finish(story.element, ElementTransition::end, ElementStatus::complete);
    }
  }

  void settle_group(const ManeuverGroup& group) {
    if (element(group.element).status != ElementStatus::running) return;
    for (const Maneuver& maneuver : group.maneuvers) {
      for (const Event& event : maneuver.events) {
        if (element(event.element).status == ElementStatus::running && all_complete(event.actions)) {
          finish(event.element, ElementTransition::end, after_execution(event));
        }
      }
      if (all_complete(maneuver.events)) finish(maneuver.element, ElementTransition::end, ElementStatus::complete);
    }
    if (!all_complete(group.maneuvers)) return;
    finish(group.element, ElementTransition::end, ElementStatus::complete);
    if (!group.maneuvers.empty() && element(group.element).executions < group.maximum_executions) begin_group(group);
  }

  const Scenario& scenario_;
  const road::RoadNetwork& network_;
  ScenarioState& state_;
  StepResult& result_;
  struct PendingAction {
    const Action* action;
    std::vector<EntityIndex> actors;
  };
  std::vector<PendingAction> pending_;
};

/// Init's teleports. Where one entity's position depends on another's, theirs may stand in any order.
Expected<void> place_at_start(const Scenario& scenario, const road::RoadNetwork& network, ScenarioState& state,
                              StepResult& result) {
  std::vector<const InitAction*> waiting;
  for (const InitAction& action : scenario.init) {
    const auto* teleport = std::get_if<TeleportAction>(&action.what);
    if (teleport == nullptr || std::holds_alternative<std::monostate>(teleport->position)) continue;
    waiting.push_back(&action);
  }
  for (std::size_t before = waiting.size() + 1; waiting.size() < before;) {
    before = waiting.size();
    std::erase_if(waiting, [&](const InitAction* action) {
      const auto& position = std::get<TeleportAction>(action->what).position;
      if (!resolve_position(network, state, position)) return false;
      start_action(scenario, network, action->what, no_element, {action->entity}, state, result);
      return true;
    });
  }
  if (waiting.empty()) return {};
  const InitAction& action = *waiting.front();
  return failure(fmt::format("{} cannot be put on the road: {}", scenario.entities[action.entity].name,
                             why_nowhere(scenario, network, state, std::get<TeleportAction>(action.what).position)),
                 action.where, "name a place that the OpenDRIVE file has");
}

}  // namespace

Expected<ScenarioState> start_scenario(const Scenario& scenario, const road::RoadNetwork& network, EntityIndex external,
                                       StepResult& result) {
  ScenarioState state;
  state.entities.resize(scenario.entities.size());
  state.values = scenario.values;
  state.routes = plan_routes(network, scenario);
  state.elements.resize(scenario.element_count);
  state.conditions.resize(scenario.condition_count);
  if (external != no_entity) state.entities[external].external = true;
  // Positions first: a speed or a lane may depend on another entity's place.
  if (auto placed = place_at_start(scenario, network, state, result); !placed) return tl::unexpected(placed.error());
  for (const InitAction& action : scenario.init) {
    if (std::holds_alternative<TeleportAction>(action.what)) continue;
    std::vector<EntityIndex> actors;
    if (action.entity != no_entity) actors.push_back(action.entity);
    start_action(scenario, network, action.what, no_element, actors, state, result);
  }
  for (EntityState& entity : state.entities) {
    entity.velocity_mps = entity.world_from_entity.orientation * Vec3(entity.speed_mps, 0.0, 0.0);
  }
  return state;
}

Error why_without_place(const Scenario& scenario, EntityIndex entity) {
  const std::string& name = scenario.entities[entity].name;
  for (const InitAction& action : scenario.init) {
    if (action.entity != entity || !std::holds_alternative<TeleportAction>(action.what)) continue;
    return {fmt::format("{} is put at a position of a kind that is not supported", name), action.where,
            "put it at a LanePosition, RoadPosition or WorldPosition"};
  }
  return {fmt::format("nothing puts {} anywhere", name), "Init", "give it a TeleportAction in <Init>"};
}

StepResult advance_scenario(const Scenario& scenario, const road::RoadNetwork& network, double dt_s,
                            ScenarioState& state) {
  SEPTET_CHECK(dt_s > 0.0, "dt {}", dt_s);
  StepResult result;
  state.step_sequence = state.sequence++;
  Step step(scenario, network, state, result);
  step.run_storyboard();
  step.move_entities(dt_s);
  for (EntityState& entity : state.entities) {
    if (!entity.external) continue;
    entity.standing_s = std::abs(entity.speed_mps) < 0.05 ? entity.standing_s + dt_s : 0.0;
  }
  state.time_s += dt_s;
  return result;
}

void release_entity(const Scenario& scenario, const road::RoadNetwork& network, EntityIndex entity,
                    ScenarioState& state, StepResult& result) {
  SEPTET_CHECK(entity < state.entities.size(), "entity {} of {}", entity, state.entities.size());
  Step(scenario, network, state, result).release(state.entities[entity]);
}

void bring_into_world(const road::RoadNetwork& network, EntityIndex entity, const road::LanePosition& lane,
                      ScenarioState& state) {
  SEPTET_CHECK(entity < state.entities.size(), "entity {} of {}", entity, state.entities.size());
  const auto placement = resolve_position(
      network, state, LaneCoordinates{network.roads[lane.road].id, lane.lane, lane.s_m, lane.offset_m, {}});
  if (!placement) return;
  state.entities[entity] = {};
  place_entity(state.entities[entity], *placement);
}

Expected<void> trigger_element(const Scenario& scenario, const road::RoadNetwork& network, ElementIndex element,
                               ScenarioState& state, StepResult& result) {
  if (element >= state.elements.size())
    return failure("there is no such element", "storyboard", "name an act or an event of the scenario");
  if (const auto no = Step(scenario, network, state, result).trigger(element))
    return failure(*no, scenario.element_names[element], "choose an act or an event that has not begun");
  return {};
}

}  // namespace septet::scenario

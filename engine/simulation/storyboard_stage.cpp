#include "engine/simulation/storyboard_stage.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/driver_eyes.hpp"
#include "engine/simulation/effects/effects_stage.hpp"
#include "engine/simulation/guidance.hpp"
#include "engine/simulation/people_stage.hpp"
#include "engine/simulation/thrown_stage.hpp"
#include "engine/world/hazard.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/people_errors.hpp"

namespace septet::simulation {
namespace {

const char* name_of(scenario::ElementStatus status) {
  switch (status) {
    case scenario::ElementStatus::standby:
      return "standby";
    case scenario::ElementStatus::running:
      return "running";
    case scenario::ElementStatus::complete:
      return "complete";
  }
  return "";
}

}  // namespace

Event event_of(const Call& call) { return {std::string(call_event), std::nullopt, text_of(call)}; }

std::vector<traffic::ForeignVehicle> foreign_vehicles(const Model& model, const State& state, const Participant& car) {
  std::vector<Participant> others{car};
  scenario::append_participants(model.scenario, state.scenario, first_scripted_participant, others);
  append_bodies(state, others);
  show_thrown(state, others);
  // The scenario's keep their turn when they leave their rails; traffic's come in as they do.
  std::ranges::stable_sort(others, {}, [](const Participant& p) { return std::min(p.id, first_traffic_participant); });
  std::vector<traffic::ForeignVehicle> foreign;
  foreign.reserve(others.size());
  for (const Participant& p : others)
    foreign.push_back({p.id, p.model, p.world_from_vehicle, p.velocity_mps, p.lamps,
                       find_loose(state, p.id) != nullptr || is_thrown(state, p.id) || is_box(p), box_size_of(p)});
  return foreign;
}

traffic::TrafficParameters swarm_parameters(const scenario::TrafficSwarmAction& swarm) {
  traffic::TrafficParameters parameters = traffic::motorway_traffic(swarm.vehicle_count, swarm.semi_major_axis_m);
  parameters.first_id = first_traffic_participant;
  if (const double both = swarm.same_direction_weight + swarm.opposite_direction_weight; both > 0.0)
    parameters.opposite_share = swarm.opposite_direction_weight / both;
  std::vector<traffic::KindShare> mix;
  for (const auto& entry : swarm.categories) mix.push_back({scenario::kind_of_category(entry.category), entry.weight});
  traffic::set_mix(parameters, mix);
  return parameters;
}

void apply_swarms(const Model& model, const scenario::StepResult& step, const Participant& car, State& state) {
  for (const auto& swarm : step.swarms) {
    drop_traffic_bodies(state);
    state.traffic->start(swarm_parameters(swarm), foreign_vehicles(model, state, car));
  }
  if (step.stopped_traffic.empty()) return;
  drop_traffic_bodies(state);
  state.traffic->stop();
}

void apply_errors(const Model& model, const scenario::StepResult& step, State& state, std::vector<Event>& events) {
  const auto tell = [&](const Expected<void>& done) {
    if (!done)
      events.push_back({std::string(people_error_event), std::nullopt, "refused=\"" + done.error().what + '"'});
  };
  for (const PeopleErrorRates& rates : step.error_rates) tell(state.traffic->set_errors(rates));
  for (const scenario::OverlookAction& action : step.overlooked)
    tell(state.traffic->overlook(
        action.who, action.whom == scenario::no_entity ? driver_participant : number_of(model, action.whom)));
}

namespace {

/// The stretch of a lane, where an entity's place gives it: from there on ahead, within its road. Empty: it stands in no lane.
std::optional<scenario::EffectAction> stretch_to_freeze(const Model& model, const State& state,
                                                        scenario::EffectAction action) {
  if (action.entity == scenario::no_entity) return action;
  const scenario::EntityState& entity = state.scenario.entities[action.entity];
  if (!entity.active || !entity.on_road) return std::nullopt;
  const road::Road& road = model.roads.roads[entity.lane.road];
  action.road = road.id;
  action.lane = entity.lane.lane;
  action.length_m = std::min(action.length_m, entity.along_s ? road.length_m - entity.lane.s_m : entity.lane.s_m);
  action.s_m = entity.along_s ? entity.lane.s_m : entity.lane.s_m - action.length_m;
  return action;
}

}  // namespace

void apply_effects(const Model& model, const scenario::StepResult& step, const Participant& car, State& state) {
  using Kind = scenario::EffectAction::Kind;
  for (const scenario::EffectAction& action : step.effects) {
    if (action.kind == Kind::freeze) {
      if (const auto stretch = stretch_to_freeze(model, state, action))
        freeze(model.roads, *stretch, state.effects.ice);
      continue;
    }
    const ParticipantId id = number_of(model, action.entity);
    if (action.kind == Kind::spill) {
      spill(action, model.scenario.entities[action.entity], state.scenario.entities[action.entity], id, state.effects);
      continue;
    }
    if (action.kind == Kind::extinguish) extinguish(id, state.effects.fires);
    if (action.kind != Kind::ignite) continue;
    std::vector<Participant> participants{car};
    scenario::append_participants(model.scenario, state.scenario, first_scripted_participant, participants);
    append_bodies(state, participants);
    if (const auto burning = std::ranges::find(participants, id, &Participant::id); burning != participants.end())
      ignite(model.roads, *burning, model.seed, state.effects.fires);
  }
}

void tell_hazards(const scenario::StepResult& step, const Model& model, const State& state,
                  std::vector<Event>& events) {
  for (const scenario::BegunHazard& hazard : step.hazards) {
    if (hazard.actors.empty())
      events.push_back({std::string(hazard_event), std::nullopt, text_of(HazardNote{true, hazard.name})});
    for (const scenario::EntityIndex actor : hazard.actors) {
      const ParticipantId id = number_of(model, actor);
      events.push_back({std::string(hazard_event), id, text_of(HazardNote{is_known(state, id), hazard.name})});
    }
  }
}

void advance_storyboard(const Model& model, const DrivenCar& car, State& state, std::vector<Event>& events) {
  scenario::place_external(model.roads, model.driver_entity, car.outputs.world_from_vehicle, car.outputs.velocity_mps,
                           car.outputs.acceleration_mps2, state.scenario);
  place_in_storyboard(model, state);
  carry_out(model, scenario::advance_scenario(model.scenario, model.roads, tick_s, state.scenario), car.participant,
            state, events);
}

void carry_out(const Model& model, const scenario::StepResult& step, const Participant& car, State& state,
               std::vector<Event>& events) {
  for (const auto& event : step.events)
    events.push_back(
        {"scenario", std::nullopt,
         fmt::format("element={} state={}", model.scenario.element_names[event.element], name_of(event.to))});
  for (const scenario::EntityIndex entity : step.left)
    events.push_back({"scenario", first_scripted_participant + entity,
                      fmt::format("entity={} state=left_at_road_end", model.scenario.entities[entity].name)});
  for (const scenario::EntityIndex entity : step.reset)
    note_bad_numbers(1, first_scripted_participant + entity, "entity", state, events);
  for (const Call& call : step.calls) events.push_back(event_of(call));
  tell_hazards(step, model, state, events);
  apply_swarms(model, step, car, state);
  apply_errors(model, step, state, events);
  if (step.people) start_people(model, *step.people, car, state);
  apply_effects(model, step, car, state);
  for (const auto& places : step.guided)
    if (auto guided = guide_over(model, places, state, events); !guided)
      events.push_back({"guidance", driver_participant, "refused=\"" + guided.error().what + '"'});
}

}  // namespace septet::simulation

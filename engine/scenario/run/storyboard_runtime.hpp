#pragma once
/// Runs a scenario: the storyboard's triggers and actions, and the motion of the scripted entities.
///
///     ScenarioState state = *start_scenario(scenario, network);
///     each tick:  place_external(…the driver's car…, state);
///                 const StepResult result = advance_scenario(scenario, network, tick_s, state);
///
/// A step at time t evaluates the triggers with the world at t, starts the actions that they fire, and then moves the
/// scripted entities to t + dt. Pure functions of their arguments; one thread at a time per state. The rules for
/// elements, edges, delays and priorities are those of OpenSCENARIO XML 1.3, "Storyboard and entities", "Conditions and
/// triggers".

#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/core/hash.hpp"
#include "engine/road/road_network.hpp"
#include "engine/scenario/run/scenario_state.hpp"
#include "engine/world/call.hpp"
#include "engine/world/people.hpp"
#include "engine/world/people_errors.hpp"

namespace septet::scenario {

/// One transition of a storyboard element, for the log.
struct StoryboardEvent {
  double time_s = 0.0;
  ElementIndex element = no_element;
  ElementTransition transition = ElementTransition::none;
  ElementStatus to = ElementStatus::standby;
};

/// A hazard that begins now: its name, and those who are it (several, one or nobody).
struct BegunHazard {
  std::string name;
  std::vector<EntityIndex> actors;
};

/// The storyboard's requests to other stages.
struct StepResult {
  std::vector<StoryboardEvent> events;
  std::vector<TrafficSwarmAction> swarms;     ///< Swarms to be started.
  std::vector<EffectAction> effects;          ///< Effects to be spilled, ignited, extinguished.
  std::vector<Call> calls;                    ///< Messages to all who listen.
  std::vector<PeopleErrorRates> error_rates;  ///< Rates at which people err from now on.
  std::vector<OverlookAction> overlooked;     ///< Who is to be overlooked.
  std::optional<PeopleWish> people;           ///< Who is to walk around the driver's car.
  /// Routes of the entity that is moved from outside: the places that it is to be guided over.
  std::vector<std::vector<road::LanePosition>> guided;
  std::vector<std::string> stopped_traffic;  ///< Names of swarms to be ended.
  std::vector<BegunHazard> hazards;
  std::vector<EntityIndex> left;   ///< Entities that came to the end of their road, and are no participants any more.
  std::vector<EntityIndex> reset;  ///< Entities with NaN or infinite numbers: they stand.
  std::vector<EntityIndex> teleported;  ///< Entities that did not come to their places by driving.
};

/// The state after the Init actions at time 0; their requests are added to `result`. `external` names the entity that
/// is moved from outside (no_entity: none); its Init position and speed are in the state for the caller to take. Error:
/// a position that is not on the road.
Expected<ScenarioState> start_scenario(const Scenario& scenario, const road::RoadNetwork& network, EntityIndex external,
                                       StepResult& result);

/// Reason why Init leaves an entity without a place: it has no TeleportAction, or one to a position that is not
/// supported.
Error why_without_place(const Scenario& scenario, EntityIndex entity);

/// Sets an external entity's present place.
void place_external(const road::RoadNetwork& network, EntityIndex entity, const RigidTransform& world_from_entity,
                    const Vec3& velocity_mps, const Vec3& acceleration_mps2, ScenarioState& state);

/// Call between two steps: from now on the entity is moved from outside, as after a crash. Running actions of its are
/// stopped, with those elements that have nothing left to do; later ones that would move it wait for ever. Its requests
/// are added to `result`.
void release_entity(const Scenario& scenario, const road::RoadNetwork& network, EntityIndex entity,
                    ScenarioState& state, StepResult& result);

/// Call between two steps: an entity that is not in the world comes into it, standing in a lane as one drives there.
void bring_into_world(const road::RoadNetwork& network, EntityIndex entity, const road::LanePosition& lane,
                      ScenarioState& state);

/// Sets the obstacle in a scripted entity's path, each step anew; empty: its path is clear. It brakes for that and
/// regains the speed of its script afterwards. `beside_is_taken`: the target place of its lateral action is occupied;
/// the action then begins when that place is free. An entity without this call drives its script, into others too.
void mind_the_way(EntityIndex entity, std::optional<InTheWay> in_the_way, bool beside_is_taken, ScenarioState& state);

/// True while the entity's lateral action has not begun to move it aside.
bool has_yet_to_move_aside(const EntityState& entity);

/// One step of dt_s, from state.time_s.
StepResult advance_scenario(const Scenario& scenario, const road::RoadNetwork& network, double dt_s,
                            ScenarioState& state);

/// Call between two steps: an operator starts an act or an event whose trigger has not fired yet; an event's act with
/// it. Its requests are added to `result`. Error: there is no such element, it is neither act nor event, or it runs or
/// has ended; then nothing has changed.
Expected<void> trigger_element(const Scenario& scenario, const road::RoadNetwork& network, ElementIndex element,
                               ScenarioState& state, StepResult& result);

/// The scripted entities as participants, entity i with id first_id + i; external and inactive ones, misc objects and
/// those that have come to the end of the road are left out.
void append_participants(const Scenario& scenario, const ScenarioState& state, ParticipantId first_id,
                         std::vector<Participant>& participants);

void add_to_hash(const ScenarioState& state, StateHash& hash);

}  // namespace septet::scenario

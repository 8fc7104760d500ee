#pragma once
/// The simulation: all models and all state of one drive, and one step of it.
///
/// `SimulationModel` is const after loading; `SimulationState` is everything that changes. `server_step` reads like the
/// diagram of the design: driver input → vehicle → storyboard → traffic → effects → snapshot. No file, socket or clock in here
/// (a traffic engine that has a socket keeps it to itself): the same model, seed and inputs give the same state hash at every tick.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/physics/vehicle/hull.hpp"
#include "engine/physics/vehicle/vehicle.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/obstacles.hpp"
#include "engine/scenario/scenario.hpp"
#include "engine/scenario/storyboard_runtime.hpp"
#include "engine/traffic/traffic_engine.hpp"
#include "engine/world/driver_input.hpp"
#include "engine/world/snapshot.hpp"
#include "engine/world/wire_snapshot.hpp"
#include "sim-server/effects_stage.hpp"

namespace septet::server {

inline constexpr double tick_rate_hz = 120.0;
inline constexpr ParticipantId driver_participant = 1;
inline constexpr ParticipantId first_scripted_participant = 2;   ///< The scenario's entities, in its order.
inline constexpr ParticipantId first_traffic_participant = 1000;

static_assert(first_scripted_participant + scenario::most_entities <= first_traffic_participant);
static_assert(first_scripted_participant + scenario::most_entities + scenario::most_swarm_vehicles <= max_wire_participants);

struct SimulationModel {
  road::RoadNetwork roads;
  scenario::Scenario scenario;
  scenario::EntityIndex driver_entity = scenario::no_entity;  ///< Whom the scenario calls its driver's car.
  vehicle::VehicleParameters car;
  std::shared_ptr<const roadside::Obstacles> obstacles;  ///< What stands beside the roads; nothing where empty.
  std::uint64_t seed = 1;
};

struct SimulationState {
  Tick tick = 0;
  vehicle::VehicleState car;
  vehicle::HullState hull;
  std::array<road::RoadPosition, vehicle::wheel_count> wheel_roads{};  ///< Where each wheel was, to find it again.
  std::array<bool, vehicle::wheel_count> at_kerb{};  ///< Which wheels touch a kerb's edge: one event a touch.
  std::optional<road::RoadPosition> car_road;
  scenario::ScenarioState scenario;
  std::unique_ptr<traffic::TrafficEngine> traffic;
  EffectsState effects;
  DriverInput input;  ///< Of the last step.
  Diagnostics diagnostics;
  std::vector<ParticipantId> touching;  ///< Who overlapped the car last tick, ascending: one collision counts once.

  double time_s() const { return static_cast<double>(tick) / tick_rate_hz; }
};

/// Something that happened in a step, for the log.
struct SimulationEvent {
  std::string kind;  ///< "scenario", "collision", "kerb", "bad_number".
  std::optional<ParticipantId> participant;
  std::string detail;
};

/// The state at tick 0, after the scenario's Init actions. Error: a scenario that does not fit its road, or `traffic` fails.
Expected<SimulationState> initial_state(const SimulationModel& model, std::unique_ptr<traffic::TrafficEngine> traffic);

/// One tick on; answers the snapshot of the new tick. Events are appended. `old` is a snapshot that nobody needs any more: its
/// memory is used again.
Snapshot server_step(const SimulationModel& model, const DriverInput& input, SimulationState& state,
                     std::vector<SimulationEvent>& events, Snapshot old = {});

Snapshot capture_snapshot(const SimulationModel& model, const SimulationState& state, Snapshot old = {});

std::uint64_t hash_state(const SimulationState& state);

}  // namespace septet::server

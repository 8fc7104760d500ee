#pragma once
/// What does not change during a drive: roads, scenario, car, what stands beside the road, seed; and the numbers of who takes part.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/physics/vehicle/vehicle_parameters.hpp"
#include "engine/road/road_network.hpp"
#include "engine/roadside/obstacles.hpp"
#include "engine/roadside/raised_areas.hpp"
#include "engine/scenario/model/scenario.hpp"
#include "engine/traffic/yield_line.hpp"
#include "engine/world/traffic_light.hpp"
#include "engine/world/wire_snapshot.hpp"

namespace septet::simulation {

inline constexpr double tick_rate_hz = 120.0;
inline constexpr double tick_s = 1.0 / tick_rate_hz;
inline constexpr ParticipantId driver_participant = 1;
inline constexpr ParticipantId first_scripted_participant = 2;  ///< The scenario's entities, in its order.
inline constexpr ParticipantId first_traffic_participant = 1000;

static_assert(first_scripted_participant + scenario::most_entities <= first_traffic_participant);
static_assert(first_scripted_participant + scenario::most_entities + scenario::most_swarm_vehicles <=
              max_wire_participants);

/// A head of lamps that the scenario switches.
struct SwitchedLight {
  std::string signal;  ///< Its id in the road file.
  TrafficLight head;   ///< Its lamps stay dark here: lights_stage.hpp.
};

struct Model {
  road::RoadNetwork roads;
  scenario::Scenario scenario;
  scenario::EntityIndex driver_entity = scenario::no_entity;  ///< Whom the scenario calls its driver's car.
  vehicle::VehicleParameters car;
  std::shared_ptr<const roadside::Obstacles> obstacles;  ///< What stands beside the roads; nothing where empty.
  std::shared_ptr<const roadside::RaisedAreas> raised;   ///< Kerbs and islands that are objects; nothing where empty.
  std::vector<SwitchedLight> lights;                     ///< In the order of the road file.
  std::vector<traffic::YieldLine> yield_lines;           ///< None: nobody examines (examiner.hpp).
  std::uint64_t seed = 1;
  std::uint64_t sources_hash =
      0;  ///< Of the texts that it was read from: models with equal ones are equal. 0: it was read from none.
};

}  // namespace septet::simulation

#pragma once
/// Constants of a drive: roads, scenario, car, obstacles beside the road, seed; and the numbers of the participants.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/physics/vehicle/vehicle_parameters.hpp"
#include "engine/road/road_network.hpp"
#include "engine/roadside/obstacles.hpp"
#include "engine/roadside/raised_areas.hpp"
#include "engine/scenario/model/scenario.hpp"
#include "engine/simulation/given_motion.hpp"
#include "engine/traffic/people/walkways.hpp"
#include "engine/traffic/yield_line.hpp"
#include "engine/world/people.hpp"
#include "engine/world/rider.hpp"
#include "engine/world/solid.hpp"
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
              max_wire_participants - most_solids);
static_assert(first_traffic_participant + 2 * scenario::most_swarm_vehicles <= first_person_participant);
static_assert(first_person_participant + most_people <= first_rider_participant);

/// A head of lamps that the scenario switches.
struct SwitchedLight {
  std::string signal;  ///< Its id in the road file.
  TrafficLight head;   ///< Its lamps stay dark here: lights_stage.hpp.
};

struct Model {
  road::RoadNetwork roads;
  scenario::Scenario scenario;
  scenario::EntityIndex driver_entity = scenario::no_entity;  ///< The driver's car in the scenario.
  vehicle::VehicleParameters car;
  std::shared_ptr<const roadside::Obstacles> obstacles;   ///< Obstacles beside the roads; null: none.
  std::shared_ptr<const roadside::RaisedAreas> raised;    ///< Kerbs and islands that are objects; null: none.
  std::vector<SwitchedLight> lights;                      ///< In the order of the road file.
  std::shared_ptr<const traffic::WalkwayGraph> walkways;  ///< Where people of a swarm walk; null: nowhere.
  std::vector<traffic::YieldLine> yield_lines;            ///< Empty: no examiner (examiner.hpp).
  std::shared_ptr<const GivenMotion> motion;              ///< Of the driver's car; null: somebody drives.
  std::uint64_t seed = 1;
  /// Hash of the texts that it was read from: models with equal ones are equal. 0: it was not read from texts.
  std::uint64_t sources_hash = 0;
};

/// Number of the participant that an entity of the scenario is.
inline ParticipantId number_of(const Model& model, scenario::EntityIndex entity) {
  return entity == model.driver_entity ? driver_participant : first_scripted_participant + entity;
}

}  // namespace septet::simulation

#include "engine/simulation/bodies/bodies.hpp"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

#include "engine/roadside/ground_beside.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/storyboard_stage.hpp"
#include "engine/simulation/wheel_ground.hpp"

namespace septet::simulation {
namespace {

bool is_scripted(ParticipantId id) { return id >= first_scripted_participant && id < first_traffic_participant; }

bool moves(const impact::Body& body) { return body.velocity_mps != Vec2(0.0) || body.yaw_rate_radps != 0.0; }

/// Ground below one wheel, or the body's own level where there is none.
vehicle::WheelGround ground_below(const Model& model, const State& state, const Vec3& centre_m, LooseBody& loose) {
  const RoadWeather weather = road_weather(state);
  vehicle::WheelGround ground;
  ground.point_m = Vec3(Vec2(centre_m), loose.height_m);
  ground.friction = surface_friction(nullptr, weather);
  road::RoadPosition place = loose.road.value_or(road::RoadPosition{});
  const auto outside_m =
      find_wheel_ground(model.roads, model.raised.get(), weather, centre_m, loose.road.has_value(), place, ground);
  if (outside_m) loose.road = place;
  if (!model.obstacles || (outside_m && *outside_m <= 0.0)) return ground;
  const double road_friction = ground.friction;
  find_land(model.roads, model.obstacles->terrain(), weather, centre_m, outside_m ? &place : nullptr, ground);
  if (outside_m && *outside_m <= roadside::paved_edge_m) ground.friction = road_friction;
  return ground;
}

/// Sets the body onto the ground below its wheels; returns their frictions.
std::array<double, vehicle::wheel_count> stand_on_ground(const Model& model, const State& state, LooseBody& loose) {
  const VehicleModel& shape = vehicle_models()[loose.model];
  const RigidTransform world_from_vehicle = participant_of(loose).world_from_vehicle;
  std::array<double, vehicle::wheel_count> friction{};
  Vec3 up(0.0);
  std::array<double, 2> axle_m{};  // Height of the ground below the front axle and the rear one.
  for (std::size_t i = 0; i < friction.size(); ++i) {
    const Vec3 wheel_m(i < 2 ? shape.wheelbase_m : 0.0, (i % 2 == 0 ? 0.5 : -0.5) * shape.track_m,
                       shape.wheel_radius_m);
    const vehicle::WheelGround ground = ground_below(model, state, world_from_vehicle * wheel_m, loose);
    friction[i] = ground.friction;
    up += ground.normal;
    axle_m[i / 2] += 0.5 * ground.point_m.z;
  }
  const double before_m = loose.height_m;
  loose.height_m = axle_m[1];
  loose.up = glm::normalize(up);
  loose.climb_mps = (loose.height_m - before_m) / tick_s;
  return friction;
}

}  // namespace

const LooseBody* find_loose(const State& state, ParticipantId id) {
  const auto found = std::ranges::find(state.bodies.bodies, id, &LooseBody::id);
  return found == state.bodies.bodies.end() ? nullptr : &*found;
}

LooseBody* find_loose(State& state, ParticipantId id) {
  const auto found = std::ranges::find(state.bodies.bodies, id, &LooseBody::id);
  return found == state.bodies.bodies.end() ? nullptr : &*found;
}

bool give_up_rails(const Model& model, ParticipantId id, const Participant& car, State& state,
                   std::vector<Event>& events) {
  if (!is_scripted(id)) return state.traffic && state.traffic->release(id);
  scenario::StepResult result;
  scenario::release_entity(model.scenario, model.roads, id - first_scripted_participant, state.scenario, result);
  carry_out(model, result, car, state, events);
  return true;
}

bool leave_rails(const Model& model, const Participant& participant, const Participant& car, State& state,
                 std::vector<Event>& events) {
  if (!has_four_wheels(vehicle_models()[participant.model].kind)) return false;
  if (!give_up_rails(model, participant.id, car, state, events)) return false;
  state.bodies.bodies.push_back(loose_body(participant, mass_kg(model, participant)));
  return true;
}

void advance_bodies(const Model& model, State& state) {
  for (LooseBody& loose : state.bodies.bodies) {
    loose.acceleration_mps2 = Vec2(0.0);
    loose.climb_mps = 0.0;
    if (!moves(loose.body)) continue;
    const Vec2 before_mps = loose.body.velocity_mps;
    const auto friction = stand_on_ground(model, state, loose);
    vehicle::advance_sliding(locked_wheels(vehicle_models()[loose.model], friction), tick_s, loose.body);
    loose.acceleration_mps2 = (loose.body.velocity_mps - before_mps) / tick_s;
  }
}

void place_in_storyboard(const Model& model, State& state) {
  for (const LooseBody& loose : state.bodies.bodies) {
    if (!is_scripted(loose.id)) continue;
    const Participant now = participant_of(loose);
    scenario::place_external(model.roads, loose.id - first_scripted_participant, now.world_from_vehicle,
                             now.velocity_mps, now.acceleration_mps2, state.scenario);
  }
}

void append_bodies(const State& state, std::vector<Participant>& participants) {
  for (const LooseBody& loose : state.bodies.bodies) participants.push_back(participant_of(loose));
}

void drop_traffic_bodies(State& state) {
  std::erase_if(state.bodies.bodies, [](const LooseBody& loose) { return loose.id >= first_traffic_participant; });
}

impact::Due due_of_contacts(const State& state, ParticipantId id, const impact::Body& body,
                            const BodyContact* besides) {
  impact::Due due;
  for (const BodyContact& contact : state.bodies.contacts) {
    if (&contact == besides || (contact.first != id && contact.second != id)) continue;
    for (const impact::Pulse& pulse : contact.engagement.pulses)
      contact.first == id ? impact::add_due(pulse, body, due) : impact::add_due_to_second(pulse, body, due);
  }
  return due;
}

}  // namespace septet::simulation

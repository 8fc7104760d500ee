#include "engine/simulation/bodies/bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/physics/vehicle/planar_body.hpp"
#include "engine/roadside/ground_beside.hpp"
#include "engine/scenario/model/misc_object.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/bodies/loose_hull.hpp"
#include "engine/simulation/hull_crashes.hpp"
#include "engine/simulation/solid_motion.hpp"
#include "engine/simulation/storyboard_stage.hpp"
#include "engine/simulation/wheel_ground.hpp"
#include "engine/traffic/people/people.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/people.hpp"
#include "engine/world/solid.hpp"

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

/// Sets the body onto the ground below its feet; returns their frictions.
std::array<double, vehicle::wheel_count> stand_on_ground(const Model& model, const State& state, LooseBody& loose) {
  const Participant now = participant_of(loose);
  const auto feet = feet_m(loose);
  std::array<double, vehicle::wheel_count> friction{};
  Vec3 up(0.0);
  std::array<double, 2> axle_m{};  // Height of the ground below the front axle and the rear one.
  for (std::size_t i = 0; i < friction.size(); ++i) {
    const vehicle::WheelGround ground = ground_below(model, state, now.world_from_vehicle * feet[i], loose);
    friction[i] = ground.friction;
    up += ground.normal;
    axle_m[i / 2] += 0.5 * ground.point_m.z;
  }
  const double before_m = loose.height_m;
  // The origin of a vehicle is below its rear axle, of a box in its middle.
  loose.height_m = is_box(now) ? 0.5 * (axle_m[0] + axle_m[1]) : axle_m[1];
  loose.up = glm::normalize(up);
  loose.climb_mps = (loose.height_m - before_m) / tick_s;
  return friction;
}

/// Slides through a tick, step by step against what stands in the way.
void slide_on(const Model& model, LooseBody& loose, State& state, std::vector<Event>& events) {
  const Vec2 before_mps = loose.body.velocity_mps;
  const auto wheels = locked_wheels(loose, stand_on_ground(model, state, loose));
  const std::vector<Obstacle> obstacles = obstacles_near(model, state.gone, loose);
  if (obstacles.empty() && loose.hull.touches.empty()) {
    vehicle::advance_sliding(wheels, tick_s, loose.body);
  } else {
    constexpr double step_s = tick_s / vehicle::sliding_steps;
    const std::vector<vehicle::HullTouch> touches_before = loose.hull.touches;
    vehicle::HullReport met;
    for (int i = 0; i < vehicle::sliding_steps; ++i) {
      vehicle::slide(wheels, step_s, loose.body);
      meet_obstacles(obstacles, step_s, due_of_contacts(state, loose.id, loose.body), loose, met);
    }
    vehicle::come_to_rest(loose.body);
    note_hull({loose.id, side_of(loose), mass_centre_ahead_m(model, participant_of(loose))}, touches_before, loose.hull,
              met, state, events);
  }
  loose.acceleration_mps2 = (loose.body.velocity_mps - before_mps) / tick_s;
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

double mass_kg(const Model& model, const State& state, const Participant& participant) {
  const LooseBody* solid = is_solid(participant.id) ? find_loose(state, participant.id) : nullptr;
  return solid ? solid->body.mass_kg : mass_kg(model, participant);
}

std::optional<impact::Body> pushed_body(const Model& model, const State& state, ParticipantId id) {
  if (id == driver_participant) return vehicle::planar_body(model.car.body, state.car);
  const LooseBody* loose = find_loose(state, id);
  return loose ? std::optional(loose->body) : std::nullopt;
}

bool give_up_rails(const Model& model, ParticipantId id, const Participant& car, State& state,
                   std::vector<Event>& events) {
  if (is_person_of_swarm(id)) return traffic::release(id, state.people.swarm);
  if (!is_scripted(id)) return state.traffic && state.traffic->release(id);
  scenario::StepResult result;
  scenario::release_entity(model.scenario, model.roads, id - first_scripted_participant, state.scenario, result);
  carry_out(model, result, car, state, events);
  return true;
}

bool may_leave_rails(const Model& model, const Participant& participant) {
  if (is_box(participant)) return std::isfinite(mass_kg(model, participant)) || participant.velocity_mps == Vec3(0.0);
  return has_four_wheels(vehicle_models()[participant.model].kind);
}

bool leave_rails(const Model& model, const Participant& participant, const Participant& car, State& state,
                 std::vector<Event>& events) {
  if (!may_leave_rails(model, participant)) return false;
  if (!give_up_rails(model, participant.id, car, state, events)) return false;
  state.bodies.bodies.push_back(loose_body(participant, mass_kg(model, participant)));
  return true;
}

void advance_bodies(const Model& model, State& state, std::vector<Event>& events) {
  lead_solids(state);
  for (LooseBody& loose : state.bodies.bodies) {
    if (is_led(state, loose.id)) continue;
    loose.acceleration_mps2 = Vec2(0.0);
    loose.climb_mps = 0.0;
    if (moves(loose.body) || is_engaged(loose)) slide_on(model, loose, state, events);
  }
}

void place_in_storyboard(const Model& model, State& state) {
  for (const LooseBody& loose : state.bodies.bodies) {
    if (!is_scripted(loose.id)) continue;
    const Participant now = participant_of(loose);
    const scenario::EntityIndex entity = loose.id - first_scripted_participant;
    RigidTransform world_from_entity = now.world_from_vehicle;
    if (is_box(now))
      world_from_entity.position_m = now.world_from_vehicle * -scenario::foot_of_box_m(model.scenario.entities[entity]);
    scenario::place_external(model.roads, entity, world_from_entity, now.velocity_mps, now.acceleration_mps2,
                             state.scenario);
  }
}

void append_bodies(const State& state, std::vector<Participant>& participants) {
  for (const LooseBody& loose : state.bodies.bodies) participants.push_back(participant_of(loose));
}

void append_others(const Model& model, const State& state, std::vector<Participant>& participants) {
  scenario::append_participants(model.scenario, state.scenario, first_scripted_participant, participants);
  if (state.traffic) state.traffic->append_participants(participants);
  // As many participants as a snapshot holds: a swarm of the most vehicles leaves no room for the most people.
  if (participants.size() + state.people.swarm.people.size() + most_solids <= max_wire_participants)
    traffic::append_participants(state.people.swarm, participants);
  append_bodies(state, participants);
}

void drop_traffic_bodies(State& state) {
  std::erase_if(state.bodies.bodies,
                [](const LooseBody& loose) { return loose.id >= first_traffic_participant && !is_solid(loose.id); });
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

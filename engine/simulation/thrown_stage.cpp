#include "engine/simulation/thrown_stage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/core/check.hpp"
#include "engine/math/gravity.hpp"
#include "engine/physics/person/jointed_plans.hpp"
#include "engine/physics/vehicle/ground.hpp"
#include "engine/physics/vehicle/planar_body.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/crash_recording.hpp"
#include "engine/simulation/wheel_ground.hpp"
#include "engine/world/participant_shape.hpp"

namespace septet::simulation {
namespace {

/// Slower touches throw nobody: one steps aside.
constexpr double least_closing_mps = 1.0;
constexpr double rider_kg = 75.0, lightest_machine_kg = 12.0;  // bodies.toml: a bicycle's mass is its rider's.

ParticipantKind kind_of(const Participant& participant) { return vehicle_models()[participant.model].kind; }

bool can_be_thrown(ParticipantKind kind) {
  return kind == ParticipantKind::pedestrian || kind == ParticipantKind::bicycle || kind == ParticipantKind::motorcycle;
}

ModelIndex model_named(const char* name) {
  const auto index = find_vehicle_model(name);
  SEPTET_CHECK(index.has_value(), "no vehicle model {}", name);
  return *index;
}

person::MovingSolid solid_of(const Participant& vehicle, double mass_kg) {
  person::MovingSolid solid;
  solid.pieces = person::vehicle_pieces(shape_of(vehicle));
  solid.world_from_vehicle = vehicle.world_from_vehicle;
  solid.velocity_mps = vehicle.velocity_mps;
  solid.angular_velocity_radps = vehicle.angular_velocity_radps;
  solid.mass_kg = mass_kg;
  return solid;
}

bool is_near(const Participant& vehicle, const Vec3& at_m) {
  const VehicleModel model = shape_of(vehicle);
  constexpr double beyond_m = 3.0;  // A body's length and the way of a tick.
  return glm::length(vehicle.world_from_vehicle.position_m - at_m) < model.length_m + beyond_m;
}

/// The bodies that a participant would be, as they were a tick ago: a person, or a machine and its rider.
std::vector<ThrownBody> bodies_of(const Model& model, const Participant& other) {
  RigidTransform before = other.world_from_vehicle;
  before.position_m -= tick_s * other.velocity_mps;
  const double mass = mass_kg(model, other);
  const ParticipantKind kind = kind_of(other);
  ThrownBody own{other.id, other.model, other.paint, {}, {}};
  if (kind == ParticipantKind::pedestrian) {
    own.body = person::standing_body(person::BodyKind::person, mass, before, other.velocity_mps);
    return {own};
  }
  const bool pedals = kind == ParticipantKind::bicycle;
  const auto machine = pedals ? person::BodyKind::bicycle : person::BodyKind::motorcycle;
  own.model = model_named(pedals ? "bicycle-alone" : "motorcycle-alone");
  own.body = person::standing_body(machine, std::max(lightest_machine_kg, mass - rider_kg), before, other.velocity_mps);
  ThrownBody rider{
      first_rider_participant + other.id, model_named("pedestrian"), static_cast<std::uint8_t>(other.id % 12), {}, {}};
  rider.body = person::riding_body(machine, rider_kg, before, other.velocity_mps);
  return {own, rider};
}

void keep_ordered(const ThrownBody& body, std::vector<ThrownBody>& thrown) {
  thrown.insert(std::ranges::lower_bound(thrown, body.id, {}, &ThrownBody::id), body);
}

void note_crash(const Model& model, const Participant& car, const Participant& other, const person::Touches& touch,
                State& state, std::vector<Event>& events) {
  const auto crashed = [&](const Participant& one) {
    return CrashedVehicle{one.id, mass_kg(model, one), one.velocity_mps, one.angular_velocity_radps};
  };
  const Vec2 level(touch.normal);
  const double length = glm::length(level);
  const Vec3 car_to_other = length > 0.1 ? Vec3(level / length, 0.0) : Vec3(1.0, 0.0, 0.0);
  VehicleCrash crash;
  crash.first = crashed(car), crash.second = crashed(other);
  crash.point_m = touch.point_m;
  crash.normal = -car_to_other;
  crash.closing_speed_mps = touch.closing_mps;
  state.effects.crashes.struck_vehicles.push_back(crash);
  ++state.diagnostics.collisions;
  // A person is taken along at once: the car's change of speed is that of a plastic impact of the two masses.
  const double delta_v_mps = touch.closing_mps * crash.second.mass_kg / (crash.second.mass_kg + crash.first.mass_kg);
  const bool by_driver = glm::dot(car.velocity_mps, car_to_other) >= -glm::dot(other.velocity_mps, car_to_other);
  events.push_back({"collision", other.id,
                    fmt::format("closing_speed_mps={:.2f} delta_v_mps={:.2f} by={}", touch.closing_mps, delta_v_mps,
                                by_driver ? "driver" : "other")});
  OpenCrash& record = open_crash(
      {car.id, other.id, {Vec2(touch.point_m), Vec2(car_to_other)}, touch.point_m.z, touch.closing_mps}, state);
  impact::Body own = vehicle::planar_body(model.car.body, state.car);
  own.heading_rad = heading_rad(car.world_from_vehicle.orientation);
  note_first(own, mass_centre_ahead_m(model, car), true, record);
  note_second(impact_side(other, crash.second.mass_kg).body, mass_centre_ahead_m(model, other), false, record);
}

/// Records what a thrown body has given the car in this tick.
void record_push(const Model& model, ParticipantId thrown, const Vec3& on_car_ns, State& state) {
  if (on_car_ns == Vec3(0.0)) return;
  const ParticipantId whose = thrown >= first_rider_participant ? thrown - first_rider_participant : thrown;
  OpenCrash* crash = find_open_crash(state, driver_participant, whose);
  if (crash)
    note_push(state.tick, {vehicle::planar_body(model.car.body, state.car), crash->second, -Vec2(on_car_ns)}, *crash);
}

void begin_throws(const Model& model, const Participant& car, const std::vector<Participant>& participants,
                  State& state, std::vector<Event>& events) {
  for (const Participant& other : participants) {
    if (other.id == car.id || !can_be_thrown(kind_of(other)) || is_thrown(state, other.id)) continue;
    if (!is_near(car, other.world_from_vehicle.position_m)) continue;
    const std::vector<ThrownBody> bodies = bodies_of(model, other);
    person::Touches first;
    for (const ThrownBody& each : bodies) {
      person::JointedBody trial = each.body;
      person::MovingSolid vehicle = solid_of(car, model.car.body.mass_kg);
      const auto touch = person::advance_body({}, 0.0, tick_s, {&vehicle, 1}, trial);
      if (touch.closing_mps > first.closing_mps) first = touch;
    }
    if (first.closing_mps < least_closing_mps) continue;
    for (const ThrownBody& each : bodies) keep_ordered(each, state.thrown);
    give_up_rails(model, other.id, car, state, events);
    note_crash(model, car, other, first, state, events);
  }
}

person::Ground ground_below_body(const Model& model, const State& state, const Vec3& at_m, ThrownBody& thrown) {
  const Environment& sky = state.scenario.environment;
  const RoadWeather weather = road_weather(state);
  vehicle::WheelGround found;
  road::RoadPosition place = thrown.road.value_or(road::RoadPosition{});
  const auto outside_m =
      find_wheel_ground(model.roads, model.raised.get(), weather, at_m, thrown.road.has_value(), place, found);
  if (outside_m) thrown.road = place;
  if (model.obstacles && (!outside_m || *outside_m > 0.0))
    find_land(model.roads, model.obstacles->terrain(), weather, at_m, outside_m ? &place : nullptr, found);
  else if (!outside_m)
    found.point_m = Vec3(Vec2(at_m), 0.0);
  const double friction = vehicle::weather_friction(sky.road_wetness, sky.snow_cover, sky.temperature_k) /
                          vehicle::weather_friction(0.0, 0.0, 293.0);
  return {found.point_m, found.normal, friction};
}

}  // namespace

bool is_thrown(const State& state, ParticipantId id) {
  return std::ranges::binary_search(state.thrown, id, {}, &ThrownBody::id);
}

bool is_for_thrown_stage(const State& state, const Participant& car, const Participant& other) {
  if (is_thrown(state, other.id)) return true;
  return can_be_thrown(kind_of(other)) && glm::length(car.velocity_mps - other.velocity_mps) > least_closing_mps;
}

void show_thrown(const State& state, std::vector<Participant>& participants) {
  if (state.thrown.empty()) return;
  std::erase_if(participants, [&](const Participant& each) { return is_thrown(state, each.id); });
  for (const ThrownBody& thrown : state.thrown) {
    const person::DrawnPose pose = person::drawn_pose(thrown.body);
    Participant participant;
    participant.id = thrown.id;
    participant.model = thrown.model;
    participant.paint = thrown.paint;
    participant.world_from_vehicle = pose.world_from_body;
    participant.velocity_mps = pose.velocity_mps;
    participant.angular_velocity_radps = pose.angular_velocity_radps;
    participant.wheel_lift_m = pose.joints_rad;
    participants.push_back(participant);
  }
  std::ranges::sort(participants, {}, &Participant::id);
}

void advance_thrown(const Model& model, DrivenCar& car, std::vector<Participant>& participants, State& state,
                    std::vector<Event>& events) {
  begin_throws(model, car.participant, participants, state, events);
  if (state.thrown.empty()) return;
  person::MovingSolid own = solid_of(car.participant, model.car.body.mass_kg);
  std::vector<std::pair<ParticipantId, Vec3>> given_ns;
  for (ThrownBody& thrown : state.thrown) {
    const Vec3 at_m = person::mass_centre_m(thrown.body);
    std::vector<person::MovingSolid> near;
    bool stirred = false, by_own = false;
    for (const Participant& vehicle : participants) {
      if (can_be_thrown(kind_of(vehicle)) || !is_near(vehicle, at_m)) continue;
      const bool is_own = vehicle.id == car.participant.id;
      if (is_own)
        near.insert(near.begin(), own);
      else
        near.push_back(solid_of(vehicle, INFINITY));
      by_own = by_own || is_own;
      stirred = stirred || glm::length(vehicle.velocity_mps) > 0.1;
    }
    if (person::lies_still(thrown.body) && !stirred) continue;
    const auto ground = ground_below_body(model, state, at_m, thrown);
    person::advance_body(ground, gravity_mps2, tick_s, near, thrown.body);
    if (!by_own) continue;
    given_ns.emplace_back(thrown.id, near.front().taken_ns - own.taken_ns);
    own = near.front();
  }
  push_car(model, own.taken_ns, state, car);
  for (const auto& [id, on_car_ns] : given_ns) record_push(model, id, on_car_ns, state);
  show_thrown(state, participants);
  for (const ThrownBody& thrown : state.thrown) {
    const std::size_t entity = thrown.id - first_scripted_participant;
    if (thrown.id < first_scripted_participant || entity >= state.scenario.entities.size()) continue;
    const auto drawn = std::ranges::lower_bound(participants, thrown.id, {}, &Participant::id);
    scenario::place_external(model.roads, static_cast<scenario::EntityIndex>(entity), drawn->world_from_vehicle,
                             drawn->velocity_mps, Vec3(0.0), state.scenario);
  }
}

}  // namespace septet::simulation

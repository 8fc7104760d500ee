#include "engine/simulation/thrown_stage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/core/check.hpp"
#include "engine/math/gravity.hpp"
#include "engine/physics/person/jointed_plans.hpp"
#include "engine/physics/vehicle/ground.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/thrown_crash.hpp"
#include "engine/simulation/wheel_ground.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/people.hpp"

namespace septet::simulation {
namespace {

/// Slower touches throw nobody: one steps aside.
constexpr double least_closing_mps = 1.0;
constexpr double fastest_walk_mps = 3.0;
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

bool is_traffic(ParticipantId id) { return id >= first_traffic_participant && id < first_rider_participant; }

/// Whose body it is: a rider's is told of as that of the machine.
ParticipantId whose(const ThrownBody& thrown) {
  return thrown.id >= first_rider_participant ? thrown.id - first_rider_participant : thrown.id;
}

/// A vehicle as the solid that bodies meet; on its rails it takes impulses unmoved.
person::MovingSolid solid_of(const Model& model, const State& state, const Participant& vehicle) {
  person::MovingSolid solid;
  solid.pieces = person::vehicle_pieces(shape_of(vehicle));
  solid.world_from_vehicle = vehicle.world_from_vehicle;
  solid.velocity_mps = vehicle.velocity_mps;
  solid.angular_velocity_radps = vehicle.angular_velocity_radps;
  if (vehicle.id == driver_participant) solid.mass_kg = model.car.body.mass_kg;
  if (const LooseBody* loose = find_loose(state, vehicle.id)) solid.mass_kg = loose->body.mass_kg;
  return solid;
}

bool is_near(const Participant& vehicle, const Vec3& at_m) {
  const VehicleModel model = shape_of(vehicle);
  constexpr double beyond_m = 3.0;  // A body's length and the way of a tick.
  const Vec3 apart_m = vehicle.world_from_vehicle.position_m - at_m;
  const double within_m = model.length_m + beyond_m;
  return glm::dot(apart_m, apart_m) < within_m * within_m;
}

/// True where the vehicle's box, with all that a body reaches beside it, holds the place.
bool is_beside(const Participant& vehicle, const Vec3& at_m) {
  if (!is_near(vehicle, at_m)) return false;
  const VehicleModel model = shape_of(vehicle);
  constexpr double reach_m = 2.5;  // From the origin of a machine to its front, or to its rider, and the way of a tick.
  const Vec3 there = inverse(vehicle.world_from_vehicle) * at_m;
  return there.x < model.front_m() + reach_m && there.x > -model.rear_overhang_m - reach_m &&
         std::abs(there.y) < 0.5 * model.width_m + reach_m;
}

/// Whether this vehicle throws this other one where they meet. A walker who comes against what stands stops.
bool throws(const State& state, const Participant& vehicle, const Participant& other) {
  if (can_be_thrown(kind_of(vehicle)) || !can_be_thrown(kind_of(other))) return false;
  // Two of one engine are kept apart by it, and traffic keeps off pavements.
  const bool crosses = is_person_of_swarm(other.id) && other.lamps.has(Lamp::signal_green);
  if (is_traffic(vehicle.id) && is_traffic(other.id) && !crosses && !find_loose(state, vehicle.id)) return false;
  const double closing_mps = glm::length(vehicle.velocity_mps - other.velocity_mps);
  if (kind_of(other) == ParticipantKind::pedestrian && glm::length(vehicle.velocity_mps) <= least_closing_mps)
    return closing_mps > fastest_walk_mps;
  return closing_mps > least_closing_mps;
}

/// The bodies that a participant would be, as they were a tick ago: a person, or a machine and its rider.
std::vector<ThrownBody> bodies_of(const Model& model, const Participant& other) {
  RigidTransform before = other.world_from_vehicle;
  before.position_m -= tick_s * other.velocity_mps;
  const double mass = mass_kg(model, other);
  const ParticipantKind kind = kind_of(other);
  ThrownBody own;
  own.id = other.id, own.model = other.model, own.paint = other.paint;
  if (kind == ParticipantKind::pedestrian) {
    own.body = person::standing_body(person::BodyKind::person, mass, before, other.velocity_mps);
    return {own};
  }
  const bool pedals = kind == ParticipantKind::bicycle;
  const auto machine = pedals ? person::BodyKind::bicycle : person::BodyKind::motorcycle;
  own.model = model_named(pedals ? "bicycle-alone" : "motorcycle-alone");
  own.body = person::standing_body(machine, std::max(lightest_machine_kg, mass - rider_kg), before, other.velocity_mps);
  ThrownBody rider;
  rider.id = rider_of(other.id), rider.model = model_named("pedestrian");
  rider.paint = static_cast<std::uint8_t>(other.id % 12);
  rider.body = person::riding_body(machine, rider_kg, before, other.velocity_mps);
  return {own, rider};
}

void keep_ordered(const ThrownBody& body, std::vector<ThrownBody>& thrown) {
  thrown.insert(std::ranges::lower_bound(thrown, body.id, {}, &ThrownBody::id), body);
}

/// A vehicle meets bodies of one whom it has not met before: it is told, and the vehicle leaves its rails as after any
/// crash.
void meet(const Model& model, const Participant& car, const ThrownTouch& touch, State& state,
          std::vector<Event>& events) {
  for (ThrownBody& thrown : state.thrown)
    if (whose(thrown) == touch.other.id)
      thrown.met.insert(std::ranges::lower_bound(thrown.met, touch.vehicle.id), touch.vehicle.id);
  if (touch.vehicle.id != car.id && !find_loose(state, touch.vehicle.id))
    leave_rails(model, touch.vehicle, car, state, events);
  tell_touch(model, touch, state, events);
}

/// The hardest touch of these bodies by a vehicle in this tick; empty where they are not touched.
person::Touches trial(const person::MovingSolid& vehicle, const std::vector<ThrownBody>& bodies) {
  person::Touches hardest;
  for (const ThrownBody& each : bodies) {
    person::JointedBody body = each.body;
    person::MovingSolid moving = vehicle;
    person::advance_body({}, 0.0, tick_s, {&moving, 1}, body);
    if (moving.touches.closing_mps > hardest.closing_mps) hardest = moving.touches;
  }
  return hardest;
}

/// Those whom people on a pavement may meet: all but traffic on its rails.
std::vector<const Participant*> off_lanes(const State& state, const std::vector<Participant>& participants) {
  std::vector<const Participant*> found;
  for (const Participant& one : participants)
    if (!is_traffic(one.id) || (!is_person_of_swarm(one.id) && find_loose(state, one.id))) found.push_back(&one);
  return found;
}

void begin_throws(const Model& model, const Participant& car, const std::vector<Participant>& participants,
                  State& state, std::vector<Event>& events) {
  const std::vector<const Participant*> few =
      state.people.empty() ? std::vector<const Participant*>{} : off_lanes(state, participants);
  for (const Participant& other : participants) {
    if (!can_be_thrown(kind_of(other)) || is_thrown(state, other.id)) continue;
    std::vector<ThrownBody> bodies;
    const Participant* by = nullptr;
    person::Touches hardest;
    const auto consider = [&](const Participant& vehicle) {
      if (!is_beside(vehicle, other.world_from_vehicle.position_m) || !throws(state, vehicle, other)) return;
      if (bodies.empty()) bodies = bodies_of(model, other);
      const person::Touches touches = trial(solid_of(model, state, vehicle), bodies);
      if (touches.closing_mps > hardest.closing_mps) hardest = touches, by = &vehicle;
    };
    if (is_person_of_swarm(other.id) && !other.lamps.has(Lamp::signal_green))
      for (const Participant* vehicle : few) consider(*vehicle);
    else
      for (const Participant& vehicle : participants) consider(vehicle);
    if (hardest.closing_mps < least_closing_mps) continue;
    for (const ThrownBody& each : bodies) keep_ordered(each, state.thrown);
    give_up_rails(model, other.id, car, state, events);
    meet(model, car, {*by, other, hardest}, state, events);
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

/// One tick of all bodies among the vehicles near them.
class Meetings {
 public:
  Meetings(const Model& model, std::vector<Participant>& participants, State& state)
      : model_(model), participants_(participants), state_(state) {
    for (std::size_t i = 0; i < participants.size(); ++i) {
      const Participant& one = participants[i];
      const bool near = std::ranges::any_of(
          state.thrown, [&](const ThrownBody& thrown) { return is_near(one, person::mass_centre_m(thrown.body)); });
      if (near && !can_be_thrown(kind_of(one))) vehicles_.push_back({i, solid_of(model, state, one)});
    }
  }

  void advance(ThrownBody& thrown) {
    const Vec3 at_m = person::mass_centre_m(thrown.body);
    std::vector<std::size_t> who;
    bool stirred = false;
    for (std::size_t i = 0; i < vehicles_.size(); ++i) {
      if (!is_near(at(i), at_m)) continue;
      who.push_back(i);
      stirred = stirred || glm::length(at(i).velocity_mps) > 0.1;
    }
    if (person::lies_still(thrown.body) && !stirred) return;
    std::vector<person::MovingSolid> near;
    near.reserve(who.size());
    for (const std::size_t i : who) near.push_back(std::move(vehicles_[i].solid));
    std::vector<Vec3> before_ns;
    before_ns.reserve(near.size());
    for (const person::MovingSolid& each : near) before_ns.push_back(each.taken_ns);
    person::advance_body(ground_below_body(model_, state_, at_m, thrown), gravity_mps2, tick_s, near, thrown.body);
    for (std::size_t k = 0; k < who.size(); ++k) {
      note(at(who[k]), near[k].touches, thrown);
      losses_.push_back({at(who[k]).id, whose(thrown), near[k].taken_ns - before_ns[k]});
      vehicles_[who[k]].solid = std::move(near[k]);
    }
  }

  /// Of vehicles with bodies that they had not met, once a pair.
  const std::vector<ThrownTouch>& new_touches() const { return new_touches_; }

  /// Gives vehicles what bodies have given them.
  void push_vehicles(DrivenCar& car) {
    for (const Vehicle& vehicle : vehicles_) {
      Participant& one = participants_[vehicle.index];
      LooseBody* loose = find_loose(state_, one.id);
      if (one.id == driver_participant) push_car(model_, vehicle.solid.taken_ns, state_, car);
      if (!loose) continue;
      // One that has left its rails in this tick has taken the impulses unmoved.
      if (std::isfinite(vehicle.solid.mass_kg)) push(vehicle.solid.taken_ns, *loose);
      one = participant_of(*loose);
    }
    for (const Loss& loss : losses_) record_loss(loss.vehicle, loss.other, loss.on_vehicle_ns, state_);
  }

 private:
  struct Vehicle {
    std::size_t index;  ///< Of the participant.
    person::MovingSolid solid;
  };
  struct Loss {
    ParticipantId vehicle, other;
    Vec3 on_vehicle_ns;
  };

  const Participant& at(std::size_t vehicle) const { return participants_[vehicles_[vehicle].index]; }

  void note(const Participant& vehicle, const person::Touches& touches, const ThrownBody& thrown) {
    if (touches.closing_mps < least_closing_mps || std::ranges::binary_search(thrown.met, vehicle.id)) return;
    const Participant* other = find_participant(participants_, whose(thrown));
    const bool is_told = std::ranges::any_of(new_touches_, [&](const ThrownTouch& touch) {
      return touch.vehicle.id == vehicle.id && touch.other.id == other->id;
    });
    if (!is_told) new_touches_.push_back({vehicle, *other, touches});
  }

  const Model& model_;
  std::vector<Participant>& participants_;
  State& state_;
  std::vector<Vehicle> vehicles_;
  std::vector<Loss> losses_;
  std::vector<ThrownTouch> new_touches_;
};

}  // namespace

bool is_thrown(const State& state, ParticipantId id) {
  return std::ranges::binary_search(state.thrown, id, {}, &ThrownBody::id);
}

bool is_for_thrown_stage(const State& state, const Participant& first, const Participant& second) {
  return is_thrown(state, first.id) || is_thrown(state, second.id) || throws(state, first, second) ||
         throws(state, second, first);
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
  Meetings meetings(model, participants, state);
  for (ThrownBody& thrown : state.thrown) meetings.advance(thrown);
  for (const ThrownTouch& touch : meetings.new_touches()) meet(model, car.participant, touch, state, events);
  meetings.push_vehicles(car);
  show_thrown(state, participants);
  for (const ThrownBody& thrown : state.thrown) {
    const std::size_t entity = thrown.id - first_scripted_participant;
    if (thrown.id < first_scripted_participant || entity >= state.scenario.entities.size()) continue;
    const Participant* drawn = find_participant(participants, thrown.id);
    scenario::place_external(model.roads, static_cast<scenario::EntityIndex>(entity), drawn->world_from_vehicle,
                             drawn->velocity_mps, Vec3(0.0), state.scenario);
  }
}

}  // namespace septet::simulation

#pragma once
/// A crash site on a plane without roads: scripted vehicles drive straight on until somebody hits them. The driver's
/// car stands far away unless it is put there.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/physics/vehicle/planar_body.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/collisions.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/simulation/placed_participant.hpp"

namespace septet::simulation {

inline Model plane_model(std::size_t vehicles, double scenario_kg = 0.0) {
  Model model;
  model.scenario.entities.resize(1 + vehicles);
  model.scenario.entities[0].model = *find_vehicle_model("volvo-s80");
  for (std::size_t i = 1; i < model.scenario.entities.size(); ++i) model.scenario.entities[i].mass_kg = scenario_kg;
  model.driver_entity = 0;
  model.car = vehicle::read_car("volvo-s80");
  return model;
}

struct CrashSite {
  Model model;
  State state;
  DrivenCar car;
  std::vector<Participant> participants;  ///< The driver's car, then the others.
  std::vector<Event> events;

  /// `others` have the numbers of the scenario's second entity and those after it, ascending.
  CrashSite(Model with, const RigidTransform& car_at, double car_mps, std::vector<Participant> others)
      : model(std::move(with)) {
    state.scenario.entities.resize(model.scenario.entities.size());
    state.car = vehicle::standstill(model.car, car_at, car_mps);
    car = driven_car(model, state);
    participants = {car.participant};
    participants.insert(participants.end(), others.begin(), others.end());
  }
  explicit CrashSite(const std::vector<Participant>& others)
      : CrashSite(plane_model(others.size()), {{0.0, 1e4, 0.0}, {}}, 0.0, others) {}

  bool is_loose(const Participant& one) const { return find_loose(state, one.id) != nullptr; }

  /// A tick: who is on rails drives on, the car and bodies move; wheels of bodies push where `with_wheels`.
  void tick(bool with_wheels = true) {
    ++state.tick;
    state.car.world_from_body.position_m += tick_s * state.car.velocity_mps;
    const double turn_rad = tick_s * (state.car.world_from_body.orientation * state.car.angular_velocity_radps).z;
    state.car.world_from_body.orientation =
        glm::angleAxis(turn_rad, Vec3(0.0, 0.0, 1.0)) * state.car.world_from_body.orientation;
    if (with_wheels) {
      advance_bodies(model, state, events);
    } else {
      for (LooseBody& loose : state.bodies.bodies) {
        loose.body.mass_centre_m += tick_s * loose.body.velocity_mps;
        loose.body.heading_rad += tick_s * loose.body.yaw_rate_radps;
        loose.acceleration_mps2 = Vec2(0.0);
      }
    }
    for (Participant& one : participants)
      if (const LooseBody* loose = find_loose(state, one.id))
        one = participant_of(*loose);
      else if (one.id != driver_participant)
        one.world_from_vehicle.position_m += tick_s * one.velocity_mps;
    car = driven_car(model, state);
    participants[0] = car.participant;
    find();
  }
  void find() { find_collisions(model, car, participants, state, events); }

  impact::Body body_of(const Participant& one) const {
    if (const LooseBody* loose = find_loose(state, one.id)) return loose->body;
    if (one.id == driver_participant) return vehicle::planar_body(model.car.body, state.car);
    return impact_side(one, mass_kg(model, one)).body;
  }
  /// Of all. Its moment is kept about the point of each impact, with the arms of its touch.
  Vec2 momentum() const {
    Vec2 sum(0.0);
    for (const Participant& one : participants) {
      const impact::Body body = body_of(one);
      sum += body.mass_kg * body.velocity_mps;
    }
    return sum;
  }
  bool rests() const {
    return std::ranges::all_of(state.bodies.bodies, [](const LooseBody& loose) {
      return loose.body.velocity_mps == Vec2(0.0) && loose.body.yaw_rate_radps == 0.0;
    });
  }
  std::ptrdiff_t count(std::string_view kind) const { return std::ranges::count(events, kind, &Event::kind); }
};

inline double told(const Event& event, const std::string& key) {
  const std::string detail = " " + event.detail;
  return std::stod(detail.substr(detail.find(" " + key + "=") + key.size() + 2));
}

}  // namespace septet::simulation

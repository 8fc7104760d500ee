#include "engine/simulation/collisions.hpp"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "engine/simulation/car_impacts.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "engine/simulation/thrown_stage.hpp"

namespace septet::simulation {
namespace {

/// No part of a vehicle is farther than this from its origin.
double reach_m(const VehicleModel& model) { return model.length_m + model.width_m; }

StruckVehicle struck_vehicle(const Model& model, const Participant& car, const Participant& other,
                             const impact::Impact& impact) {
  StruckVehicle struck;
  struck.vehicle = other.id;
  struck.point_m = Vec3(impact.touch.place.point_m, contact_height_m(body_box(car), body_box(other)));
  struck.normal = Vec3(-impact.touch.place.normal, 0.0);
  struck.velocity_mps = car.velocity_mps;
  struck.angular_velocity_radps = car.angular_velocity_radps;
  struck.closing_speed_mps = impact.pulse.impulse.closing_mps;
  struck.car_kg = mass_kg(model, car);
  struck.vehicle_kg = mass_kg(model, other);
  return struck;
}

}  // namespace

void find_collisions(const Model& model, const Participant& car, const std::vector<Participant>& participants,
                     State& state, std::vector<Event>& events) {
  std::vector<ParticipantId> touching;
  // No collision is possible from this distance on: nearly all participants are dismissed by this test alone.
  double apart_m = 0.0;
  for (const VehicleModel& each : vehicle_models()) apart_m = std::max(apart_m, 2.0 * reach_m(each));
  for (const Participant& other : participants) {
    if (other.id == car.id) continue;
    const Vec2 apart = other.world_from_vehicle.position_m - car.world_from_vehicle.position_m;
    if (glm::dot(apart, apart) > apart_m * apart_m || !contact_of(body_box(car), body_box(other))) continue;
    if (is_for_thrown_stage(state, car, other)) continue;
    touching.push_back(other.id);
    if (std::ranges::binary_search(state.touching, other.id)) continue;
    ++state.diagnostics.collisions;
    const auto impact = begin_impact(model, car, other, state);
    if (impact) state.effects.crashes.struck_by_driver.push_back(struck_vehicle(model, car, other, *impact));
    const double closing_mps = impact ? impact->pulse.impulse.closing_mps : 0.0;
    const double delta_v_mps = impact ? glm::length(impact->pulse.impulse.on_second_ns) / mass_kg(model, car) : 0.0;
    events.push_back(
        {"collision", other.id, fmt::format("closing_speed_mps={:.2f} delta_v_mps={:.2f}", closing_mps, delta_v_mps)});
  }
  state.touching = std::move(touching);
}

}  // namespace septet::simulation

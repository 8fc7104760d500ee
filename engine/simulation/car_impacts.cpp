#include "engine/simulation/car_impacts.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "engine/physics/impact/restitution.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "engine/world/vehicle_body.hpp"

namespace septet::simulation {
namespace {

impact::Body car_body(const Model& model, const vehicle::VehicleState& car) {
  impact::Body body;
  body.mass_kg = model.car.body.mass_kg;
  body.yaw_inertia_kgm2 = model.car.body.inertia_kgm2.z;
  body.mass_centre_m = Vec2(car.world_from_body.position_m);
  body.velocity_mps = Vec2(car.velocity_mps);
  body.yaw_rate_radps = (car.world_from_body.orientation * car.angular_velocity_radps).z;
  return body;
}

/// Takes over what an impact has changed within `dt_s`.
void take_over(const impact::Body& before, const impact::Body& after, double dt_s, vehicle::VehicleState& car) {
  const Vec3 up(0.0, 0.0, 1.0);
  const Vec3 change(after.velocity_mps - before.velocity_mps, 0.0);
  const Vec3 turn =
      glm::conjugate(car.world_from_body.orientation) * ((after.yaw_rate_radps - before.yaw_rate_radps) * up);
  car.velocity_mps += change;
  car.angular_velocity_radps += turn;
  car.acceleration_mps2 += change / dt_s;
  car.whole_acceleration_mps2 += change / dt_s;
  car.angular_acceleration_radps2 += turn / dt_s;
  car.world_from_body.position_m += Vec3(after.mass_centre_m - before.mass_centre_m, 0.0);
  car.world_from_body.orientation =
      glm::normalize(glm::angleAxis(after.heading_rad - before.heading_rad, up) * car.world_from_body.orientation);
}

}  // namespace

double mass_kg(const Model& model, const Participant& participant) {
  if (participant.id == driver_participant) return model.car.body.mass_kg;
  const std::size_t entity = participant.id - first_scripted_participant;
  if (participant.id >= first_scripted_participant && entity < model.scenario.entities.size())
    if (const double told_kg = model.scenario.entities[entity].mass_kg; told_kg > 0.0) return told_kg;
  return vehicle_body(vehicle_models()[participant.model].kind).mass_kg;
}

impact::Side impact_side(const Participant& participant, double mass_kg) {
  const debris::Box box = body_box(participant);
  impact::Side side;
  side.outline = outline_of(box);
  side.body.mass_kg = mass_kg;
  side.body.yaw_inertia_kgm2 = mass_kg / 3.0 * glm::dot(side.outline.half_m, side.outline.half_m);
  side.body.mass_centre_m = side.outline.centre_m;
  side.body.velocity_mps = Vec2(box.velocity_mps);
  side.body.yaw_rate_radps = participant.angular_velocity_radps.z;
  side.crush = passenger_car_crush();
  return side;
}

std::optional<impact::Impact> begin_impact(const Model& model, const Participant& car, const Participant& other,
                                           State& state) {
  impact::Side own = impact_side(car, model.car.body.mass_kg);
  own.body = car_body(model, state.car);
  const impact::Side struck = impact_side(other, mass_kg(model, other));
  auto impact = impact::meet(own, struck, impact::vehicle_friction(), tick_s);
  if (impact) state.impacts.push_back({other.id, impact->pulse, struck.body, impact->touch.age_s});
  return impact;
}

void advance_impacts(const Model& model, double dt_s, State& state) {
  for (CarImpact& running : state.impacts) {
    const impact::Body before = car_body(model, state.car);
    impact::Body after = before;
    const double time_s = dt_s + running.due_s;
    impact::advance_pulse(time_s, running.pulse, after, running.struck);
    running.due_s = 0.0;
    take_over(before, after, time_s, state.car);
  }
  std::erase_if(state.impacts, [](const CarImpact& running) { return impact::is_over(running.pulse); });
}

}  // namespace septet::simulation

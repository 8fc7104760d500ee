#include "engine/simulation/car_impacts.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "engine/physics/impact/restitution.hpp"
#include "engine/physics/vehicle/hull.hpp"
#include "engine/physics/vehicle/planar_body.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "engine/world/vehicle_body.hpp"

namespace septet::simulation {
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
  own.body = vehicle::planar_body(model.car.body, state.car);
  const impact::Side struck = impact_side(other, mass_kg(model, other));
  auto impact =
      impact::meet(own, struck, impact::vehicle_friction(), tick_s, vehicle::due_to_hull(state.hull, own.body));
  if (impact) state.impacts.push_back({other.id, impact->pulse, struck.body, impact->touch.age_s});
  return impact;
}

impact::Due due_to_car(const State& state, const impact::Body& body) {
  impact::Due due;
  for (const CarImpact& running : state.impacts) impact::add_due(running.pulse, body, due);
  return due;
}

void advance_impacts(const Model& model, double dt_s, State& state) {
  for (CarImpact& running : state.impacts) {
    const impact::Body before = vehicle::planar_body(model.car.body, state.car);
    impact::Body after = before;
    const double time_s = dt_s + running.due_s;
    impact::advance_pulse(time_s, running.pulse, after, running.struck);
    running.due_s = 0.0;
    vehicle::take_over(before, after, time_s, state.car);
  }
  std::erase_if(state.impacts, [](const CarImpact& running) { return impact::is_over(running.pulse); });
}

}  // namespace septet::simulation

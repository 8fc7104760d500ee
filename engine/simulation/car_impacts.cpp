#include "engine/simulation/car_impacts.hpp"

#include <algorithm>

#include "engine/physics/impact/restitution.hpp"
#include "engine/physics/vehicle/hull.hpp"
#include "engine/physics/vehicle/planar_body.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/crash_recording.hpp"

namespace septet::simulation {
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
  impact::Due due = due_of_contacts(state, driver_participant, body);
  for (const CarImpact& running : state.impacts) impact::add_due(running.pulse, body, due);
  return due;
}

void advance_impacts(const Model& model, double dt_s, State& state) {
  for (CarImpact& running : state.impacts) {
    const impact::Body before = vehicle::planar_body(model.car.body, state.car);
    impact::Body after = before;
    const double time_s = dt_s + running.due_s;
    const Vec2 given_ns = impact::advance_pulse(time_s, running.pulse, after, running.struck);
    running.due_s = 0.0;
    vehicle::take_over(before, after, time_s, state.car);
    if (OpenCrash* crash = find_open_crash(state, driver_participant, running.vehicle))
      note_push(state.tick, {.first = after, .second = crash->second, .on_second_ns = given_ns}, *crash);
  }
  std::erase_if(state.impacts, [](const CarImpact& running) { return impact::is_over(running.pulse); });
}

}  // namespace septet::simulation

#pragma once
/// Energy of a car, which no step may create.

#include <glm/geometric.hpp>

#include "engine/physics/vehicle/equations_of_motion.hpp"
#include "engine/physics/vehicle/suspension.hpp"
#include "engine/physics/vehicle/vehicle.hpp"
#include "engine/physics/vehicle/wheel_damage.hpp"

namespace septet::vehicle {

/// Kinetic and potential energy of the car, J, without the engine.
inline double mechanical_energy_j(const VehicleParameters& parameters, const VehicleState& state) {
  const Statics known = statics(parameters);
  const BodyParameters& body = parameters.body;
  const Vec3 v = glm::conjugate(state.world_from_body.orientation) * state.velocity_mps;
  const Vec3& w = state.angular_velocity_radps;
  double energy = 0.5 * known.sprung_mass_kg * glm::dot(v, v) + 0.5 * glm::dot(w, body.inertia_kgm2 * w) +
                  known.sprung_mass_kg * gravity_mps2 * state.world_from_body.position_m.z;
  Coordinates rates{v.x, v.y, v.z, w.x, w.y};
  for (int i = 0; i < wheel_count; ++i) rates[5 + i] = state.wheels[i].travel_rate_mps;
  for (int i = 0; i < wheel_count; ++i) {
    const SuspensionParameters& axle = parameters.suspension[axle_of(i)];
    const WheelState& wheel = state.wheels[i];
    const WheelPlace place = place_wheel(parameters, known, i, wheel, wheel.steer_rad);
    for (const Coordinates& row : centre_jacobian(place, i)) {
      double speed = 0.0;
      for (int k = 0; k < coordinate_count; ++k) speed += row[k] * rates[k];
      energy += 0.5 * axle.unsprung_mass_kg * speed * speed;
    }
    energy += 0.5 * axle.wheel_inertia_kgm2 * wheel.spin_radps * wheel.spin_radps +
              axle.unsprung_mass_kg * gravity_mps2 * (state.world_from_body * place.centre_m).z;
    // Springs and tyre, from the state at rest; Simpson's rule, near enough across the kinks.
    const double z = wheel.travel_m;
    energy += known.sprung_load_n[axle_of(i)] * z +
              z / 6.0 * (axle.spring_force_n(0.0) + 4.0 * axle.spring_force_n(0.5 * z) + axle.spring_force_n(z));
    const double twist = z - state.wheels[i ^ 1].travel_m;
    energy += 0.25 * axle.anti_roll_npm * twist * twist;
    energy += radial_energy_j(parameters.tyre, wheel.damage, wheel.squeeze_m);
  }
  return energy;
}

}  // namespace septet::vehicle

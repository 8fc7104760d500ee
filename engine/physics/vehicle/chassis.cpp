#include <algorithm>
#include <cmath>

#include "engine/physics/vehicle/body_contact.hpp"
#include "engine/physics/vehicle/equations_of_motion.hpp"
#include "engine/physics/vehicle/published_chassis.hpp"
#include "engine/physics/vehicle/suspension.hpp"
#include "engine/physics/vehicle/vehicle.hpp"
#include "engine/physics/vehicle/wheel_load.hpp"

// Velocities are advanced with forces at the old positions, positions with the new velocities (symplectic Euler);
// brakes and tyres are implicit in wheel spin and in deflection. Left out: gyroscopic moments of the wheels.

namespace septet::vehicle {
namespace {

constexpr double air_density_kgpm3 = 1.225;

double square(double x) { return x * x; }

/// Drag and lift at the axles; the wind stands still.
void add_aerodynamics(const BodyParameters& body, const Statics& known, const Vec3& velocity_mps, Vec3& force_n,
                      Vec3& moment_nm) {
  const double speed_mps = glm::length(velocity_mps);
  const double pressure_pa = 0.5 * air_density_kgpm3;
  force_n -= pressure_pa * body.drag_area_m2 * speed_mps * velocity_mps;
  for (int axle = 0; axle < axle_count; ++axle) {
    const double lift_n = pressure_pa * body.lift_area_m2[axle] * square(velocity_mps.x);
    force_n.z += lift_n;
    moment_nm.y -= known.axle_x_m[axle] * lift_n;
  }
}

}  // namespace

void advance_chassis(const VehicleParameters& parameters, const ChassisInput& input, const Ground& ground, double dt_s,
                     VehicleState& state) {
  const Statics known = statics(parameters);
  const BodyParameters& body = parameters.body;
  const Quat world_from_body = state.world_from_body.orientation;
  const Quat body_from_world = glm::conjugate(world_from_body);
  const Vec3 velocity_mps = body_from_world * state.velocity_mps;
  const Vec3 up = body_from_world * Vec3(0.0, 0.0, 1.0), gravity = -gravity_mps2 * up;
  const Vec3& omega = state.angular_velocity_radps;

  std::array<double, wheel_count> spring_n{};
  for (int i = 0; i < wheel_count; ++i) spring_n[i] = suspension_force_n(parameters, known, i, state.wheels);

  std::array<WheelLoad, wheel_count> loads;
  std::array<WheelPlace, wheel_count> places;
  for (int i = 0; i < wheel_count; ++i) {
    loads[i] = advance_wheel({parameters, known, input, ground[i], state, velocity_mps, dt_s}, i, state.wheels[i]);
    places[i] = loads[i].place;
  }

  Vec3 force_n{0.0}, moment_nm{0.0};  // On the whole car, about the centre of the sprung mass.
  Coordinates generalised{};
  for (int i = 0; i < wheel_count; ++i) {
    const WheelLoad& load = loads[i];
    const WheelPlace& place = places[i];
    const Vec3& tyre_n = load.force_n;
    const Vec3& contact = load.contact_m;
    force_n += tyre_n;
    moment_nm += load.aligning_nm;
    moment_nm.x += contact.y * tyre_n.z - contact.z * tyre_n.y + load.lean_nm;
    moment_nm.y += contact.z * tyre_n.x - contact.x * tyre_n.z;
    if (!parameters.as_published)
      moment_nm.y += load.rolling_torque_nm - load.shaft_torque_nm;  // Torque that spins the wheel.
    moment_nm.z += parameters.as_published ? published_yaw_moment_nm(parameters, known, i, up, tyre_n)
                                           : contact.x * tyre_n.y - contact.y * tyre_n.x;

    // A rigid axle leans about its one joint: both wheels' forces work on either wheel's travel, their sum at the
    // contacts' height over the joint, their difference on the present lean.
    const SuspensionParameters& suspension = parameters.suspension[axle_of(i)];
    double sideways_n = tyre_n.y * place.contact_slope.y;
    if (suspension.rigid_axle) {
      const Vec3& opposite_n = loads[i ^ 1].force_n;
      const double lean = side_of(i) * (state.wheels[i ^ 1].travel_m - state.wheels[i].travel_m) / suspension.track_m;
      sideways_n = 0.5 * (tyre_n.y * place.contact_slope.y - opposite_n.y * places[i ^ 1].contact_slope.y);
      sideways_n += 0.5 * (tyre_n.y - opposite_n.y) * lean;
      sideways_n += side_of(i) * (load.lean_nm + loads[i ^ 1].lean_nm) / suspension.track_m;
    } else {
      sideways_n -= side_of(i) * suspension.camber_rad.slope(state.wheels[i].travel_m) * load.lean_nm;
    }
    // Virtual work along the wheel's path: longitudinal forces act at the centre, as the wheel
    // turns freely, and the brake turns with the carrier.
    const double radius_m = std::max(0.1, place.centre_m.z - contact.z);
    generalised[5 + i] = tyre_n.z - spring_n[i] + load.rolling_n.x * place.centre_slope.x +
                         (tyre_n.x - load.rolling_n.x) * place.contact_slope.x +
                         load.brake_torque_nm / radius_m * (place.contact_slope.x - place.centre_slope.x) + sideways_n;

    // Yaw takes the centres of the sprung mass and of the whole car to coincide in plan, so the
    // wheels' weight on a leaning car must not turn it either.
    const double mass_kg = suspension.unsprung_mass_kg;
    if (!parameters.as_published)
      moment_nm.z += mass_kg * (place.centre_m.x * gravity.y - place.centre_m.y * gravity.x);
    const double centripetal_n = mass_kg * glm::cross(omega, glm::cross(omega, place.centre_m)).z;
    generalised[2] -= centripetal_n;
    generalised[3] -= centripetal_n * place.centre_m.y;
    generalised[4] += centripetal_n * place.centre_m.x;
    generalised[5 + i] -= centripetal_n;
  }
  add_aerodynamics(body, known, velocity_mps, force_n, moment_nm);
  add_body_contact(parameters, ground, state, velocity_mps, force_n, moment_nm);
  moment_nm -= glm::cross(omega, body.inertia_kgm2 * omega);
  for (int i = 0; i < 3; ++i) generalised[i] += force_n[i];
  generalised[3] += moment_nm.x;
  generalised[4] += moment_nm.y;
  const double yaw_radps2 = moment_nm.z / body.inertia_kgm2.z;
  if (parameters.as_published) {
    add_upright_axles(parameters, spring_n, state, generalised);
    add_yawing_axles(parameters, places, yaw_radps2, generalised);
    add_weightless_axles(parameters, places, up, force_n, generalised);
  }

  const Coordinates felt = accelerations(parameters, known, places, generalised);
  const Vec3 linear = Vec3(felt[0], felt[1], felt[2]) + gravity;
  const Vec3 angular{felt[3], felt[4],
                     parameters.as_published ? published_yaw_acceleration(yaw_radps2, up, omega, felt[4]) : yaw_radps2};
  for (int i = 0; i < wheel_count; ++i) {
    WheelState& wheel = state.wheels[i];
    wheel.travel_rate_mps += dt_s * felt[5 + i];
    wheel.travel_m += dt_s * wheel.travel_rate_mps;
  }
  state.acceleration_mps2 = world_from_body * linear;
  state.whole_acceleration_mps2 = world_from_body * (force_n / body.mass_kg + gravity);
  state.angular_acceleration_radps2 = angular;
  state.velocity_mps += dt_s * state.acceleration_mps2;
  state.angular_velocity_radps += dt_s * angular;
  state.world_from_body.position_m += dt_s * state.velocity_mps;
  const Vec3 turn = 0.5 * dt_s * state.angular_velocity_radps;
  state.world_from_body.orientation =
      glm::normalize(world_from_body + world_from_body * Quat(0.0, turn.x, turn.y, turn.z));
}

}  // namespace septet::vehicle

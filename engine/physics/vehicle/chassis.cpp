#include <algorithm>
#include <cmath>

#include "engine/physics/vehicle/body_contact.hpp"
#include "engine/physics/vehicle/suspension.hpp"
#include "engine/physics/vehicle/tyre.hpp"
#include "engine/physics/vehicle/vehicle.hpp"

// Equations of motion. The unsprung masses move up and down along the body's z axis; across it they
// move with the body, whose mass is therefore the whole car's in x and y and the sprung mass in z.
// Velocities are advanced with forces at the old positions, positions with the new velocities
// (symplectic Euler); brakes and tyres are implicit in wheel spin and in deflection. Left out:
// gyroscopic moments of the wheels.

namespace septet::vehicle {
namespace {

constexpr double air_density_kgpm3 = 1.225;

/// One wheel during one step, in the body's axes.
struct WheelLoad {
  WheelPlace place;
  Vec3 contact_m{0.0};
  Vec3 force_n{0.0};
  Vec3 aligning_nm{0.0};
  double shaft_torque_nm = 0.0;  ///< Drive and brake together, about the spin axis.
  double brake_torque_nm = 0.0;  ///< The brake's share.
};

double square(double x) { return x * x; }

/// Spin after one step. The brake holds up to its torque and never turns the wheel.
double spin_wheel(double spin_radps, double torque_nm, double brake_nm, double inertia_kgm2,
                  double dt_s, double& brake_used_nm) {
  const double free_radps = spin_radps + dt_s * torque_nm / inertia_kgm2;
  const double most_radps = dt_s * brake_nm / inertia_kgm2;
  const double taken_radps = std::clamp(free_radps, -most_radps, most_radps);
  brake_used_nm = -taken_radps * inertia_kgm2 / dt_s;
  return free_radps - taken_radps;
}

/// Contact, tyre force and new spin of one wheel.
WheelLoad advance_wheel(const VehicleParameters& parameters, const Statics& known, int index,
                        const ChassisInput& input, const WheelGround& ground, double dt_s,
                        const VehicleState& state, const Vec3& velocity_mps, WheelState& wheel) {
  const TyreParameters& tyre = parameters.tyre;
  const Quat world_from_body = state.world_from_body.orientation;
  WheelLoad load;
  wheel.steer_rad = wheel_steer_rad(parameters, index, wheel, input.steer_rad);
  load.place = place_wheel(parameters, known, index, wheel, wheel.steer_rad);
  const Vec3& axis = load.place.spin_axis;
  const Vec3& centre_m = load.place.centre_m;

  const Vec3 normal = glm::conjugate(world_from_body) * ground.normal;
  const double height_m =
      glm::dot(ground.normal, state.world_from_body * centre_m - ground.point_m);
  const double deflection_m = tyre.radius_m - height_m;
  const Vec3 across = glm::cross(axis, normal);
  const double across_size = glm::length(across);
  // Nothing to stand on: in the air, or the wheel lies on its side or above the car.
  const bool touching =
      deflection_m > 0.0 && deflection_m < tyre.radius_m && normal.z > 0.3 && across_size > 0.3;

  const double effective_radius_m =
      tyre.published ? tyre.radius_m : tyre.radius_m - std::clamp(deflection_m, 0.0, 0.1) / 3.0;
  double rolling_nm = 0.0;
  wheel.force_n = Vec3(0.0);
  wheel.aligning_nm = 0.0;
  if (touching) {
    const Vec3 forward = across / across_size;
    const Vec3 left = glm::cross(normal, forward);
    load.contact_m = centre_m - Vec3(0.0, 0.0, height_m / normal.z);
    const Vec3 path{load.place.contact_slope, 1.0};
    const Vec3 patch_mps = velocity_mps + glm::cross(state.angular_velocity_radps, load.contact_m) +
                           wheel.travel_rate_mps * path;
    const double load_n =
        std::max(0.0, tyre.vertical_stiffness_npm * deflection_m -
                          tyre.vertical_damping_nspm * glm::dot(patch_mps, normal));
    TyreContact contact;
    contact.load_n = load_n;
    contact.friction = ground.friction;
    contact.rolling_mps = wheel.spin_radps * effective_radius_m;
    contact.forward_mps = glm::dot(patch_mps, forward);
    contact.sliding_mps = {contact.forward_mps - contact.rolling_mps, glm::dot(patch_mps, left)};
    if (parameters.slip_without_roll_rate)
      contact.sliding_mps.y -= state.angular_velocity_radps.x * -load.contact_m.z * left.y;
    contact.inclination_rad = glm::dot(axis, normal);
    contact.length_m = std::sqrt(8.0 * tyre.radius_m * deflection_m);
    if (load_n > 1.0) {
      const TyreForce steady = steady_force(tyre, contact);
      const double most_n = 1.3 * load_n * ground.friction / tyre.reference_friction;
      const Vec2 force_n = relax(steady, most_n, dt_s, wheel.deflection_m);
      wheel.force_n = Vec3(force_n, load_n);
      wheel.aligning_nm = -steady.trail_m * force_n.y;
      wheel.slip = steady.slip.x;
      wheel.slip_angle_rad = std::atan(steady.slip.y);
      load.force_n = force_n.x * forward + force_n.y * left + load_n * normal;
      load.aligning_nm = wheel.aligning_nm * normal;
      rolling_nm =
          ground.rolling_resistance * load_n * effective_radius_m *
          (tyre.rolling_resistance + tyre.rolling_resistance_s2pm2 * square(contact.rolling_mps));
    }
  }
  if (wheel.force_n.z <= 0.0) {
    wheel.deflection_m = Vec2(0.0);
    wheel.slip = wheel.slip_angle_rad = 0.0;
  }

  const double drive_nm = input.drive_torque_nm[index];
  const double brake_nm = std::max(0.0, input.brake_torque_nm[index]);
  double friction_nm = 0.0;
  wheel.spin_radps = spin_wheel(
      wheel.spin_radps, drive_nm - wheel.force_n.x * effective_radius_m, brake_nm + rolling_nm,
      parameters.suspension[axle_of(index)].wheel_inertia_kgm2, dt_s, friction_nm);
  load.brake_torque_nm = friction_nm * brake_nm / std::max(brake_nm + rolling_nm, 1e-12);
  load.shaft_torque_nm = drive_nm + load.brake_torque_nm;
  wheel.spin_rad += dt_s * wheel.spin_radps;
  constexpr double turn_rad = 6.283185307179586;
  wheel.spin_rad -= turn_rad * std::floor(wheel.spin_rad / turn_rad);
  return load;
}

/// Drag and lift at the axles; the wind stands still.
void add_aerodynamics(const BodyParameters& body, const Statics& known, const Vec3& velocity_mps,
                      Vec3& force_n, Vec3& moment_nm) {
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

void advance_chassis(const VehicleParameters& parameters, const ChassisInput& input,
                     const Ground& ground, double dt_s, VehicleState& state) {
  const Statics known = statics(parameters);
  const BodyParameters& body = parameters.body;
  const Quat world_from_body = state.world_from_body.orientation;
  const Quat body_from_world = glm::conjugate(world_from_body);
  const Vec3 velocity_mps = body_from_world * state.velocity_mps;
  const Vec3 gravity = body_from_world * Vec3(0.0, 0.0, -gravity_mps2);
  const Vec3& omega = state.angular_velocity_radps;

  std::array<double, wheel_count> spring_n{};
  for (int i = 0; i < wheel_count; ++i)
    spring_n[i] = suspension_force_n(parameters, known, i, state.wheels);

  std::array<WheelLoad, wheel_count> loads;
  Vec3 force_n{0.0},
      moment_nm{0.0};  // On the body, without gravity; force.z on the sprung mass only.
  for (int i = 0; i < wheel_count; ++i) {
    loads[i] = advance_wheel(parameters, known, i, input, ground[i], dt_s, state, velocity_mps,
                             state.wheels[i]);
    force_n.x += loads[i].force_n.x;
    force_n.y += loads[i].force_n.y;
  }
  add_aerodynamics(body, known, velocity_mps, force_n, moment_nm);
  add_body_contact(parameters, ground, state, velocity_mps, force_n, moment_nm);

  // What the links carry: tyre force less the unsprung mass's own share of the acceleration felt in
  // x and y.
  const Vec2 felt_mps2 = Vec2(force_n) / body.mass_kg;
  std::array<double, wheel_count>
      wheel_force_n{};  // Along the body's z on the unsprung mass, without gravity.
  for (int i = 0; i < wheel_count; ++i) {
    const WheelLoad& load = loads[i];
    const SuspensionParameters& suspension = parameters.suspension[axle_of(i)];
    const Vec2 contact_n{load.force_n}, inertia_n = suspension.unsprung_mass_kg * felt_mps2;
    const double radius_m = std::max(0.1, load.place.centre_m.z - load.contact_m.z);
    // Virtual work along the wheel's path: longitudinal forces act at the centre, the brake turns
    // with the carrier.
    const double path_n =
        (contact_n.x - inertia_n.x) * load.place.centre_slope.x +
        load.brake_torque_nm / radius_m * (load.place.contact_slope.x - load.place.centre_slope.x) +
        contact_n.y * load.place.contact_slope.y - inertia_n.y * load.place.centre_slope.y;
    const double lift_n = spring_n[i] - path_n;
    wheel_force_n[i] = load.force_n.z - lift_n;
    force_n.z += lift_n;

    const Vec3& centre = load.place.centre_m;
    const Vec3& contact = load.force_n.z > 0.0 ? load.contact_m : centre;
    moment_nm.x += centre.y * lift_n - contact.z * contact_n.y + centre.z * inertia_n.y;
    moment_nm.y +=
        centre.z * (contact_n.x - inertia_n.x) - centre.x * lift_n - load.shaft_torque_nm;
    moment_nm.z += contact.x * contact_n.y - contact.y * contact_n.x;
    moment_nm += load.aligning_nm;
  }

  const Vec3 inertia = body.inertia_kgm2;
  const Vec3 angular = (moment_nm - glm::cross(omega, inertia * omega)) / inertia;
  const Vec3 linear{force_n.x / body.mass_kg + gravity.x, force_n.y / body.mass_kg + gravity.y,
                    force_n.z / known.sprung_mass_kg + gravity.z};
  for (int i = 0; i < wheel_count; ++i) {
    const Vec3& centre = loads[i].place.centre_m;
    const Vec3 carried =
        linear + glm::cross(angular, centre) + glm::cross(omega, glm::cross(omega, centre));
    const double mass_kg = parameters.suspension[axle_of(i)].unsprung_mass_kg;
    WheelState& wheel = state.wheels[i];
    wheel.travel_rate_mps += dt_s * (wheel_force_n[i] / mass_kg + gravity.z - carried.z);
    wheel.travel_m += dt_s * wheel.travel_rate_mps;
  }
  state.acceleration_mps2 = world_from_body * linear;
  state.angular_acceleration_radps2 = angular;
  state.velocity_mps += dt_s * state.acceleration_mps2;
  state.angular_velocity_radps += dt_s * angular;
  state.world_from_body.position_m += dt_s * state.velocity_mps;
  const Vec3 turn = 0.5 * dt_s * state.angular_velocity_radps;
  state.world_from_body.orientation =
      glm::normalize(world_from_body + world_from_body * Quat(0.0, turn.x, turn.y, turn.z));
}

}  // namespace septet::vehicle

#include <algorithm>
#include <cmath>

#include "engine/physics/vehicle/body_contact.hpp"
#include "engine/physics/vehicle/equations_of_motion.hpp"
#include "engine/physics/vehicle/published_chassis.hpp"
#include "engine/physics/vehicle/suspension.hpp"
#include "engine/physics/vehicle/tyre.hpp"
#include "engine/physics/vehicle/vehicle.hpp"

// Velocities are advanced with forces at the old positions, positions with the new velocities (symplectic Euler);
// brakes and tyres are implicit in wheel spin and in deflection. Left out: gyroscopic moments of the wheels.

namespace septet::vehicle {
namespace {

constexpr double air_density_kgpm3 = 1.225;

/// One wheel during one step, in the body's axes.
struct WheelLoad {
  WheelPlace place;
  Vec3 contact_m{0.0};
  Vec3 force_n{0.0};
  Vec3 aligning_nm{0.0};
  Vec3 rolling_n{0.0};             ///< Part of force_n along the wheel's heading.
  double rolling_torque_nm = 0.0;  ///< Torque of that part on the wheel, against its spin.
  double lean_nm = 0.0;            ///< Moment of the load on a contact shifted sideways.
  double shaft_torque_nm = 0.0;    ///< Drive and brake together, about the spin axis.
  double brake_torque_nm = 0.0;    ///< The brake's share.
};

double square(double x) { return x * x; }

/// Spin after one step. The brake holds up to its torque and never turns the wheel.
double spin_wheel(double spin_radps, double torque_nm, double brake_nm, double inertia_kgm2, double dt_s,
                  double& brake_used_nm) {
  const double free_radps = spin_radps + dt_s * torque_nm / inertia_kgm2;
  const double most_radps = dt_s * brake_nm / inertia_kgm2;
  const double taken_radps = std::clamp(free_radps, -most_radps, most_radps);
  brake_used_nm = -taken_radps * inertia_kgm2 / dt_s;
  return free_radps - taken_radps;
}

/// The plane that carries a wheel: its ground, or the one that touches an edge across the line from there to the
/// wheel's centre (`edge_m` stays set).
WheelGround carrying_plane(const WheelGround& ground, const Vec3& centre_m, const Vec3& forward) {
  WheelGround result = ground;
  result.edge_m.reset();
  if (!ground.edge_m) return result;
  const Vec3 to_centre = centre_m - *ground.edge_m;
  const double ahead_m = glm::dot(to_centre, forward) / glm::length(forward);
  const double up_m = glm::dot(to_centre, ground.normal);
  const double distance_m = std::hypot(ahead_m, up_m);
  constexpr double least_up_m = 0.05;  // A higher edge than the hub is a wall: the hull meets it.
  if (up_m < least_up_m || distance_m >= glm::dot(ground.normal, centre_m - ground.point_m)) return result;
  result.normal = glm::normalize(up_m * ground.normal + ahead_m / glm::length(forward) * forward);
  result.point_m = centre_m - distance_m * result.normal;
  result.edge_m = ground.edge_m;
  return result;
}

/// Contact, tyre force and new spin of one wheel.
WheelLoad advance_wheel(const VehicleParameters& parameters, const Statics& known, int index, const ChassisInput& input,
                        const WheelGround& ground, double dt_s, const VehicleState& state, const Vec3& velocity_mps,
                        double opposite_rate_mps, WheelState& wheel) {
  const TyreParameters& tyre = parameters.tyre;
  const Quat world_from_body = state.world_from_body.orientation;
  WheelLoad load;
  wheel.steer_rad = wheel_steer_rad(parameters, index, wheel, input.steer_rad);
  load.place = place_wheel(parameters, known, index, wheel, wheel.steer_rad);
  const Vec3& axis = load.place.spin_axis;
  const Vec3& centre_m = load.place.centre_m;

  const WheelGround met =
      carrying_plane(ground, state.world_from_body * centre_m, world_from_body * glm::cross(axis, Vec3(0.0, 0.0, 1.0)));
  const Vec3 normal = glm::conjugate(world_from_body) * met.normal;
  // The published height of an axle leaves out that its centre moves sideways under a leaning body.
  const Vec3 measured_m =
      parameters.as_published
          ? Vec3(centre_m.x, side_of(index) * 0.5 * parameters.suspension[axle_of(index)].track_m, centre_m.z)
          : centre_m;
  const double height_m = glm::dot(met.normal, state.world_from_body * measured_m - met.point_m);
  // From 0.6 of the radius on the rim would be flat; the force stays at its value there.
  const double deflection_m = std::min(tyre.radius_m - height_m, 0.6 * tyre.radius_m);
  const Vec3 across = glm::cross(axis, normal);
  const double across_size = glm::length(across);
  // False in the air, or where the wheel lies on its side or above the car.
  const bool touching = deflection_m > 0.0 && normal.z > 0.3 && across_size > 0.3;

  const double effective_radius_m =
      tyre.published ? tyre.radius_m : tyre.radius_m - std::clamp(deflection_m, 0.0, 0.1) / 3.0;
  double rolling_nm = 0.0;
  wheel.force_n = Vec3(0.0);
  wheel.aligning_nm = 0.0;
  wheel.squeeze_m = touching ? deflection_m : 0.0;
  press_wheel(tyre, ground.yields ? 0.0 : wheel.squeeze_m, dt_s, wheel.damage);
  if (touching) {
    const Vec3 body_forward = level_forward(normal), body_left = glm::cross(normal, body_forward);
    // The published heading is the steer angle's alone, although a wheel that leans on a pitched body turns by that.
    const Vec3 forward = parameters.as_published
                             ? std::cos(wheel.steer_rad) * body_forward + std::sin(wheel.steer_rad) * body_left
                             : across / across_size;
    const Vec3 left = glm::cross(normal, forward);
    // A round wheel's lowest point lies under its centre, however the body pitches; sideways it follows the axle.
    load.contact_m = centre_m - height_m * normal;
    if (!met.edge_m) {
      load.contact_m.y = load.place.contact_left_m;
      load.contact_m.z = centre_m.z - height_m * (1.0 - square(normal.x)) / normal.z;
    }
    const SuspensionParameters& suspension = parameters.suspension[axle_of(index)];
    Vec3 path_mps = wheel.travel_rate_mps * Vec3(load.place.contact_slope, 1.0);
    if (suspension.rigid_axle) {
      // Its joint hangs on the axle: the lower the wheel's centre, the deeper the joint lies under the contact, which
      // moves only as the axle leans.
      load.place.contact_slope.y +=
          side_of(index) * (height_m - known.centre_z_m[axle_of(index)]) / (0.5 * suspension.track_m);
      path_mps.y = 0.5 * (wheel.travel_rate_mps - opposite_rate_mps) * load.place.contact_slope.y;
    }
    const Vec3 patch_mps = velocity_mps + glm::cross(state.angular_velocity_radps, load.contact_m) + path_mps;
    const double out_mps = glm::dot(patch_mps, normal);
    double load_n = std::max(
        0.0, radial_force_n(tyre, wheel.damage, deflection_m, ground.yields) - tyre.vertical_damping_nspm * out_mps);
    // A wheel whose hub lies under the ground has not been driven there: it is lifted out slowly, not thrown.
    constexpr double most_out_mps = 1.0;
    if (height_m < 0.0) load_n *= std::clamp(1.0 - out_mps / most_out_mps, 0.0, 1.0);
    TyreContact contact;
    contact.load_n = load_n;
    contact.friction = ground.friction * wheel.damage.grip();
    contact.firmness = wheel.damage.firmness();
    contact.rolling_mps = wheel.spin_radps * effective_radius_m;
    contact.forward_mps = glm::dot(patch_mps, forward);
    contact.sliding_mps = {contact.forward_mps - contact.rolling_mps, glm::dot(patch_mps, left)};
    contact.inclination_rad = glm::dot(axis, normal);
    if (parameters.as_published) {
      const Vec2 published_mps =
          published_contact_velocity_mps(parameters, known, index, state, velocity_mps, normal, height_m);
      contact.forward_mps = published_mps.x;
      contact.sliding_mps = {published_mps.x - contact.rolling_mps, published_mps.y};
      contact.inclination_rad = published_inclination_rad(axis, normal);
    }
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
      load.rolling_n = force_n.x * forward;
      load.rolling_torque_nm = force_n.x * effective_radius_m;
      load.lean_nm = load_n * force_n.y * suspension.contact_by_lateral_force_mpn;
      load.aligning_nm = wheel.aligning_nm * normal;
      rolling_nm = ground.rolling_resistance * wheel.damage.rolling_resistance() * load_n * effective_radius_m *
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
  wheel.spin_radps = spin_wheel(wheel.spin_radps, drive_nm - load.rolling_torque_nm, brake_nm + rolling_nm,
                                parameters.suspension[axle_of(index)].wheel_inertia_kgm2, dt_s, friction_nm);
  load.brake_torque_nm = friction_nm * brake_nm / std::max(brake_nm + rolling_nm, 1e-12);
  load.shaft_torque_nm = drive_nm + load.brake_torque_nm;
  wheel.spin_rad += dt_s * wheel.spin_radps;
  constexpr double turn_rad = 6.283185307179586;
  wheel.spin_rad -= turn_rad * std::floor(wheel.spin_rad / turn_rad);
  return load;
}

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
    loads[i] = advance_wheel(parameters, known, i, input, ground[i], dt_s, state, velocity_mps,
                             state.wheels[i ^ 1].travel_rate_mps, state.wheels[i]);
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

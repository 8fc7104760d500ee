#include "engine/physics/vehicle/published_chassis.hpp"

#include <algorithm>
#include <cmath>

namespace septet::vehicle {
namespace {

/// The car's heading on a ground with this normal: forward along the body, level.
Vec3 level_forward(const Vec3& normal) { return glm::normalize(Vec3(1.0, 0.0, 0.0) - normal.x * normal); }

/// Velocity of one wheel's contact over the ground, along the wheel's heading and to its left: the sideways and forward
/// velocity of the sprung mass, yaw about the vertical, and the rolling of the axle. Left out are the motion of the
/// wheels forward or back with a pitching body, and its turn about its roll axis by yaw. `height_m`: of the wheel's
/// centre.
Vec2 published_contact_velocity_mps(const VehicleParameters& parameters, const Statics& known, int wheel,
                                    const VehicleState& state, const Vec3& velocity_mps, const Vec3& normal,
                                    double height_m) {
  const Vec3& omega = state.angular_velocity_radps;
  const double track_m = parameters.suspension[axle_of(wheel)].track_m, side = side_of(wheel);
  const double heading_radps = (normal.y * omega.y + normal.z * omega.z) / (normal.y * normal.y + normal.z * normal.z);
  const double roll_radps = omega.x - normal.x * heading_radps;
  const double axle_roll_radps =
      roll_radps + side * (state.wheels[wheel].travel_rate_mps - state.wheels[wheel ^ 1].travel_rate_mps) / track_m;
  const Vec3 forward = level_forward(normal), left = glm::cross(normal, forward);
  const double forward_mps = glm::dot(velocity_mps, forward) - 0.5 * side * track_m * heading_radps;
  const double left_mps =
      glm::dot(velocity_mps, left) + known.axle_x_m[axle_of(wheel)] * heading_radps + axle_roll_radps * height_m;
  const double cosine = std::cos(state.wheels[wheel].steer_rad), sine = std::sin(state.wheels[wheel].steer_rad);
  return {cosine * forward_mps + sine * left_mps, cosine * left_mps - sine * forward_mps};
}

/// Inclination of a wheel's spin axis against the ground, steer not counted: a steered wheel does not lean with a
/// pitched body.
double published_inclination_rad(const Vec3& spin_axis, const Vec3& normal) {
  return std::sqrt(1.0 - spin_axis.z * spin_axis.z) * normal.y + spin_axis.z * normal.z;
}

}  // namespace

Vec3 published_measured_m(const VehicleParameters& parameters, int wheel, const Vec3& centre_m) {
  return {centre_m.x, side_of(wheel) * 0.5 * parameters.suspension[axle_of(wheel)].track_m, centre_m.z};
}

Vec3 published_heading(double steer_rad, const Vec3& normal) {
  const Vec3 body_forward = level_forward(normal), body_left = glm::cross(normal, body_forward);
  return std::cos(steer_rad) * body_forward + std::sin(steer_rad) * body_left;
}

void publish_contact(const VehicleParameters& parameters, const Statics& known, int wheel, const VehicleState& state,
                     const Vec3& velocity_mps, const Vec3& spin_axis, const Vec3& normal, double height_m,
                     TyreContact& contact) {
  const Vec2 published_mps =
      published_contact_velocity_mps(parameters, known, wheel, state, velocity_mps, normal, height_m);
  contact.forward_mps = published_mps.x;
  contact.sliding_mps = {published_mps.x - contact.rolling_mps, published_mps.y};
  contact.inclination_rad = published_inclination_rad(spin_axis, normal);
}

double published_yaw_moment_nm(const VehicleParameters& parameters, const Statics& known, int wheel, const Vec3& up,
                               const Vec3& tyre_n) {
  const Vec3 forward = level_forward(up);
  const Vec3 left = glm::cross(up, forward);
  const int axle = axle_of(wheel);
  const double left_m = 0.5 * side_of(wheel) * parameters.suspension[axle].track_m;
  return known.axle_x_m[axle] * glm::dot(tyre_n, left) - left_m * glm::dot(tyre_n, forward);
}

double published_yaw_acceleration(double yaw_radps2, const Vec3& up, const Vec3& omega_radps, double pitch_radps2) {
  // Contribution of the turning of `up`.
  const double turned_radps2 = omega_radps.x * (up.z * omega_radps.y - up.y * omega_radps.z);
  return (yaw_radps2 - turned_radps2 - up.y * pitch_radps2) / std::max(up.z, 0.1);
}

void add_upright_axles(const VehicleParameters& parameters, const std::array<double, wheel_count>& spring_n,
                       const VehicleState& state, Coordinates& generalised) {
  for (int left = 0; left < wheel_count; left += 2) {
    const int right = left + 1;
    const double track_m = parameters.suspension[axle_of(left)].track_m;
    const double lean_rad = (state.wheels[right].travel_m - state.wheels[left].travel_m) / track_m;
    const double moment_nm = -(spring_n[left] + spring_n[right]) * parameters.tyre.radius_m * lean_rad;
    generalised[3] += moment_nm;
    generalised[5 + left] += moment_nm / track_m;
    generalised[5 + right] -= moment_nm / track_m;
  }
}

void add_yawing_axles(const VehicleParameters& parameters, const std::array<WheelPlace, wheel_count>& places,
                      double yaw_radps2, Coordinates& generalised) {
  for (int i = 0; i < wheel_count; ++i) {
    const double force_n = -parameters.suspension[axle_of(i)].unsprung_mass_kg * places[i].centre_m.x * yaw_radps2;
    const Coordinates sideways = centre_jacobian(places[i], i)[1];
    for (int k = 0; k < coordinate_count; ++k) generalised[k] += sideways[k] * force_n;
  }
}

void add_weightless_axles(const VehicleParameters& parameters, const std::array<WheelPlace, wheel_count>& places,
                          const Vec3& up, const Vec3& force_n, Coordinates& generalised) {
  const double forward_mps2 = glm::dot(force_n, level_forward(up)) / parameters.body.mass_kg;
  for (int i = 0; i < wheel_count; ++i)
    generalised[4] += parameters.suspension[axle_of(i)].unsprung_mass_kg * places[i].centre_m.z * forward_mps2;
}

}  // namespace septet::vehicle

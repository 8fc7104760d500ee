#include "engine/physics/vehicle/published_chassis.hpp"

#include <algorithm>

namespace septet::vehicle {

double published_yaw_moment_nm(const VehicleParameters& parameters, const Statics& known, int wheel,
                               const Vec3& up, const Vec3& tyre_n) {
  const Vec3 forward = level_forward(up);
  const Vec3 left = glm::cross(up, forward);
  const int axle = axle_of(wheel);
  const double left_m = 0.5 * side_of(wheel) * parameters.suspension[axle].track_m;
  return known.axle_x_m[axle] * glm::dot(tyre_n, left) - left_m * glm::dot(tyre_n, forward);
}

double published_yaw_acceleration(double yaw_radps2, const Vec3& up, double roll_radps2, double pitch_radps2) {
  return (yaw_radps2 - up.x * roll_radps2 - up.y * pitch_radps2) / std::max(up.z, 0.1);
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
    const double force_n =
        -parameters.suspension[axle_of(i)].unsprung_mass_kg * places[i].centre_m.x * yaw_radps2;
    const Coordinates sideways = centre_jacobian(places[i], i)[1];
    for (int k = 0; k < coordinate_count; ++k) generalised[k] += sideways[k] * force_n;
  }
}

}  // namespace septet::vehicle

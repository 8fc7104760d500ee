#include <algorithm>
#include <cmath>

#include "engine/physics/vehicle/controls.hpp"

namespace septet::vehicle {
namespace {
/// Lever of the friction between a standing tyre and the road when it is turned on the spot.
constexpr double bore_lever_m = 0.04;
constexpr double parking_speed_mps = 1.0;
}  // namespace

double advance_steering(const VehicleParameters& parameters, double steering_wheel_rad, double speed_mps, double dt_s,
                        VehicleState& state) {
  const SteeringParameters& steering = parameters.steering;
  SteeringState& column = state.steering;
  const double hand_rad = std::clamp(steering_wheel_rad, -steering.lock_rad, steering.lock_rad);
  const double road_rad = column.column_rad / steering.ratio;

  // Moment of the tyres about the two kingpins, positive to the left: the caster pulls the wheels straight.
  double kingpin_nm = -steering.centring_nmprad * road_rad;
  double parking_nm = 0.0;
  for (int wheel = 0; wheel < 2; ++wheel) {
    const WheelState& front = state.wheels[wheel];
    const double outward = wheel == 0 ? 1.0 : -1.0;
    kingpin_nm += front.aligning_nm - steering.mechanical_trail_m * front.force_n.y -
                  outward * steering.scrub_radius_m * front.force_n.x;
    parking_nm += bore_lever_m * front.force_n.z / (1.0 + std::abs(speed_mps) / parking_speed_mps);
  }
  const double unassisted = 1.0 - std::clamp(steering.assistance.held(std::abs(speed_mps)), 0.0, 1.0);
  const double tyre_nm = unassisted * kingpin_nm / steering.ratio;

  const double before_rad = column.column_rad;
  if (steering.column_stiffness_nmprad > 0.0) {
    const double mobility = dt_s / steering.rack_damping_nmsprad;
    column.column_rad = (before_rad + mobility * (steering.column_stiffness_nmprad * hand_rad + tyre_nm)) /
                        (1.0 + mobility * steering.column_stiffness_nmprad);
  } else {
    column.column_rad = hand_rad;
  }
  const double rate_radps = (column.column_rad - before_rad) / dt_s;
  const double friction_nm = steering.friction_nm + unassisted * parking_nm / steering.ratio;
  column.torque_nm = tyre_nm - friction_nm * rate_radps / (std::abs(rate_radps) + 0.3);
  return column.column_rad / steering.ratio;
}

}  // namespace septet::vehicle

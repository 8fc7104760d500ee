#include "engine/physics/vehicle/suspension.hpp"

#include <algorithm>

#include "engine/physics/vehicle/elementary.hpp"

namespace septet::vehicle {

Statics statics(const VehicleParameters& parameters) {
  const BodyParameters& body = parameters.body;
  Statics result;
  result.sprung_mass_kg = body.mass_kg;
  for (const SuspensionParameters& axle : parameters.suspension) result.sprung_mass_kg -= 2.0 * axle.unsprung_mass_kg;
  result.axle_x_m = {body.wheelbase_m - body.mass_centre_x_m, -body.mass_centre_x_m};
  const double sprung_weight_n = result.sprung_mass_kg * gravity_mps2;
  result.sprung_load_n = {0.5 * sprung_weight_n * body.mass_centre_x_m / body.wheelbase_m,
                          0.5 * sprung_weight_n * result.axle_x_m[0] / body.wheelbase_m};
  for (int i = 0; i < axle_count; ++i) {
    const double load_n = result.sprung_load_n[i] + parameters.suspension[i].unsprung_mass_kg * gravity_mps2;
    result.centre_z_m[i] = parameters.tyre.radius_m - load_n / parameters.tyre.vertical_stiffness_npm;
  }
  return result;
}

WheelPlace place_wheel(const VehicleParameters& parameters, const Statics& statics, int wheel, const WheelState& state,
                       double steer_rad) {
  const int axle = axle_of(wheel);
  const double side = side_of(wheel);
  const SuspensionParameters& suspension = parameters.suspension[axle];
  const double travel = state.travel_m;
  WheelPlace place;
  const auto path_m = [&](const Table& slope) { return 0.5 * travel * (slope(0.0) + slope(travel)); };
  place.centre_m = {statics.axle_x_m[axle] + path_m(suspension.centre_longitudinal_slope),
                    side * (0.5 * suspension.track_m + path_m(suspension.centre_lateral_slope)),
                    statics.centre_z_m[axle] - parameters.body.mass_centre_z_m + travel};
  place.contact_left_m = side * (0.5 * suspension.track_m + path_m(suspension.contact_lateral_slope));
  place.contact_slope = {suspension.contact_longitudinal_slope(travel),
                         side * suspension.contact_lateral_slope(travel)};
  place.centre_slope = {suspension.centre_longitudinal_slope(travel), side * suspension.centre_lateral_slope(travel)};
  // Camber is outward on either side; about the forward axis that is negative on the left. A force
  // to the left at the contact pushes both wheels' lower edge to the left.
  const double inclination_rad =
      -side * suspension.camber_rad(travel) + suspension.camber_by_lateral_force_radpn * state.force_n.y;
  const auto [sin_steer, cos_steer] = sine_cosine(std::clamp(steer_rad, -1.5, 1.5));
  const auto [sin_lean, cos_lean] = sine_cosine(std::clamp(inclination_rad, -0.5, 0.5));
  place.spin_axis = {-sin_steer * cos_lean, cos_steer * cos_lean, sin_lean};
  return place;
}

double wheel_steer_rad(const VehicleParameters& parameters, int wheel, const WheelState& state, double mean_steer_rad) {
  const int axle = axle_of(wheel);
  const double side = side_of(wheel);
  const SuspensionParameters& suspension = parameters.suspension[axle];
  double steer_rad = -side * suspension.toe_rad(state.travel_m);
  if (axle == 0) {
    // Second order of the Ackermann condition: the inner wheel turns further.
    const double inner = 0.5 * parameters.steering.ackermann * suspension.track_m / parameters.body.wheelbase_m *
                         mean_steer_rad * mean_steer_rad;
    steer_rad += mean_steer_rad + side * inner;
  }
  steer_rad -= suspension.toe_out_by_lateral_force_radpn * state.force_n.y;
  steer_rad += suspension.steer_by_aligning_torque_radpnm * state.aligning_nm;
  if (state.damage.any()) steer_rad += side * state.damage.toe_out_rad();
  return steer_rad;
}

double suspension_force_n(const VehicleParameters& parameters, const Statics& statics, int wheel,
                          const std::array<WheelState, wheel_count>& wheels) {
  const int axle = axle_of(wheel);
  const SuspensionParameters& suspension = parameters.suspension[axle];
  const WheelState& here = wheels[wheel];
  const WheelState& opposite = wheels[wheel ^ 1];
  return statics.sprung_load_n[axle] + suspension.spring_force_n(here.travel_m) +
         suspension.damper_force_n(here.travel_rate_mps) +
         suspension.anti_roll_npm * (here.travel_m - opposite.travel_m);
}

}  // namespace septet::vehicle

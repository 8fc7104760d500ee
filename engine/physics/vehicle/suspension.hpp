#pragma once
/// Kinematics and force of the suspension.

#include <array>

#include "engine/physics/vehicle/vehicle_parameters.hpp"
#include "engine/physics/vehicle/vehicle_state.hpp"

namespace septet::vehicle {

inline constexpr int axle_of(int wheel) { return wheel / 2; }
/// +1 for a left wheel, −1 for a right one.
inline constexpr double side_of(int wheel) { return wheel % 2 == 0 ? 1.0 : -1.0; }

/// Constants that follow from the parameters.
struct Statics {
  double sprung_mass_kg = 0.0;
  std::array<double, axle_count> sprung_load_n{};  ///< Per wheel, at rest on level ground.
  std::array<double, axle_count> axle_x_m{};       ///< From the centre of the sprung mass.
  std::array<double, axle_count> centre_z_m{};     ///< Height of the wheels' centres over the ground, at rest.
};
Statics statics(const VehicleParameters& parameters);

/// One wheel against the body, in the body's axes from the centre of the sprung mass.
struct WheelPlace {
  Vec3 centre_m{0.0};
  /// The contact lies on the ground, as far ahead of the mass centre as the wheel's centre above it.
  double contact_left_m = 0.0;
  Vec2 contact_slope{0.0};  ///< d(forward, left)/d travel of the contact's path.
  Vec2 centre_slope{0.0};   ///< d(forward, left)/d travel of the centre's path.
  Vec3 spin_axis{0.0, 1.0, 0.0};
};

/// `steer_rad` is that of the wheel, with toe and compliance.
WheelPlace place_wheel(const VehicleParameters& parameters, const Statics& statics, int wheel, const WheelState& state,
                       double steer_rad);

/// Steer of one wheel: its share of the mean angle, toe, compliance under the last step's forces, and the bend of a
/// strike.
double wheel_steer_rad(const VehicleParameters& parameters, int wheel, const WheelState& state, double mean_steer_rad);

/// Upward force on the body (and downward on the wheel), spring, bump stop, damper and anti-roll bar, N.
double suspension_force_n(const VehicleParameters& parameters, const Statics& statics, int wheel,
                          const std::array<WheelState, wheel_count>& wheels);

}  // namespace septet::vehicle

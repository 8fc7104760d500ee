#include "engine/physics/vehicle/wheel_damage.hpp"

#include <algorithm>

namespace septet::vehicle {
namespace {

/// Assumed: a tread with its belt of 12 mm on a sidewall of 8 mm, squeezed by a quarter.
constexpr double pinched_rubber_m = 0.015;
/// Assumed: share of an inflated tyre's load on its carcass; a flat one keeps it.
constexpr double carcass_share = 0.15;
/// Stiffness of pinched rubber and rim. Assumed: ten times a tyre.
constexpr double rim_stiffness_npm = 2.0e6;
/// Above it the rim bends. Assumed: three times the rating of such a wheel, 650 kg.
constexpr double rim_bears_n = 20e3;
/// Derived: 30 litres through a cut of 3 cm², at the speed of sound in it: V / (0.58 · 343 m/s · A).
constexpr double leak_s = 0.5;
/// Assumed: 0.3 degrees for a rim that is bent by 10 mm, 1.1 degrees at most.
constexpr double toe_out_radpm = 0.5, most_toe_out_rad = 0.02;

/// Carried share of the tyre's stiffness.
double carried_share(const WheelDamage& damage) { return 1.0 - (1.0 - carcass_share) * damage.lost_air; }

/// Compression of rubber and rim together.
double rim_m(const TyreParameters& tyre, const WheelDamage& damage, double deflection_m) {
  return std::max(0.0, deflection_m - sidewall_m(tyre) - damage.rim_bend_m);
}

}  // namespace

double WheelDamage::toe_out_rad() const { return std::min(toe_out_radpm * rim_bend_m, most_toe_out_rad); }

double sidewall_m(const TyreParameters& tyre) { return tyre.radius_m - tyre.rim_radius_m - pinched_rubber_m; }

double radial_force_n(const TyreParameters& tyre, const WheelDamage& damage, double deflection_m, bool yields) {
  const double pressed_m = yields ? 0.0 : rim_m(tyre, damage, deflection_m);
  return tyre.vertical_stiffness_npm * deflection_m * carried_share(damage) + rim_stiffness_npm * pressed_m;
}

double radial_energy_j(const TyreParameters& tyre, const WheelDamage& damage, double deflection_m) {
  const double pressed_m = rim_m(tyre, damage, deflection_m);
  return 0.5 * (tyre.vertical_stiffness_npm * deflection_m * deflection_m * carried_share(damage) +
                rim_stiffness_npm * pressed_m * pressed_m);
}

void press_wheel(const TyreParameters& tyre, double deflection_m, double dt_s, WheelDamage& damage) {
  const double past_m = deflection_m - sidewall_m(tyre);
  damage.rim_bend_m = std::max(damage.rim_bend_m, past_m - rim_bears_n / rim_stiffness_npm);
  if (past_m > 0.0 || damage.any()) damage.lost_air += std::min(1.0, dt_s / leak_s) * (1.0 - damage.lost_air);
}

}  // namespace septet::vehicle

#pragma once
/// Damage of a wheel that is pressed down to its rim: by the edge of a kerb, by a hole, after a jump. The cause does
/// not matter here.
///
/// A sidewall gives way until its rubber lies pinched between the rim's flange and the ground; pressed further, the
/// flange cuts it (the pinch flat, or impact break) and the air leaves; the rim gives a little with the rubber, and
/// bends under loads beyond its strength: elastic, then perfectly plastic. With the rim bend the arms that hold the
/// wheel: it toes out, pushed back by the impact. A flat tyre stands on its rim and its carcass, rolls hard, has low
/// slip stiffness and less grip. Not modelled: the tread's enveloping of an edge (which softens it), rims that break,
/// tyres that come off.

#include "engine/physics/vehicle/tyre_parameters.hpp"

namespace septet::vehicle {

struct WheelDamage {
  double rim_bend_m = 0.0;  ///< Deepest bend of the flange.
  double lost_air = 0.0;    ///< 0 a whole tyre, 1 a flat one; above 0: cut.

  bool any() const { return lost_air > 0.0; }
  double toe_out_rad() const;  ///< Beside the suspension's own, in the same direction on either side.
  // Factors of a tyre that loses its air; of a whole one each is exactly 1.
  double grip() const { return 1.0 - 0.2 * lost_air; }  ///< Assumed: the tread arches off the ground.
  double firmness() const {
    return 1.0 - 0.75 * lost_air;
  }  ///< Factor of slopes and stiffness along the ground. Assumed: a quarter remains.
  double rolling_resistance() const { return 1.0 + 19.0 * lost_air; }  ///< Assumed: 0.2 of the load in place of 0.01.
};

/// Deflection of the tyre at which its flange pinches it.
double sidewall_m(const TyreParameters& tyre);

/// Force of the tyre and, through it, of the rim, at a deflection in metres that is positive. The surface does not bend
/// the rim where it `yields`.
double radial_force_n(const TyreParameters& tyre, const WheelDamage& damage, double deflection_m, bool yields = false);

/// Energy that this force has stored, J.
double radial_energy_j(const TyreParameters& tyre, const WheelDamage& damage, double deflection_m);

/// Damages the wheel by a deflection that lasts for `dt_s`.
void press_wheel(const TyreParameters& tyre, double deflection_m, double dt_s, WheelDamage& damage);

}  // namespace septet::vehicle

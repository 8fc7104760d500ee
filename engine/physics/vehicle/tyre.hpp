#pragma once
/// Steady tyre forces over slip, and their relaxation.
///
/// Slip is s = −v_s/v_T with v_s the velocity of the contact patch over the ground and v_T the transport velocity, so
/// that positive slip makes a positive force (forward, left). At rest v_T vanishes and slip grows without bound, yet
/// the product v_T · F(s) stays finite; that is all that the relaxation uses, hence no special case at standstill.

#include "engine/math/rigid_transform.hpp"
#include "engine/physics/vehicle/tyre_parameters.hpp"

namespace septet::vehicle {

/// State of a contact, the input of its tyre.
struct TyreContact {
  double load_n = 0.0;
  double friction = 0.9;         ///< Peak friction of the surface.
  Vec2 sliding_mps{0.0};         ///< Velocity of the patch over the ground: forward, left.
  double rolling_mps = 0.0;      ///< Wheel spin times effective radius.
  double forward_mps = 0.0;      ///< Velocity of the wheel along its heading.
  double inclination_rad = 0.0;  ///< Against the ground's normal, positive leans to the right.
  double length_m = 0.1;         ///< Length of the contact patch.
  /// Remaining share of slopes and stiffness: less where air is lost. Not of the published tyre.
  double firmness = 1.0;
};

/// Steady force at one slip.
struct TyreForce {
  Vec2 force_n{0.0};
  double trail_m = 0.0;  ///< Pneumatic trail: the aligning torque is −trail · lateral force.
  Vec2 slip{0.0};
  double transport_mps = 0.0;  ///< v_T.
  Vec2 secant_n{0.0};          ///< |force over slip|, at zero slip the slope.
  Vec2 stiffness_npm{0.0};     ///< Stiffness of the patch against the rim, and its damping.
  Vec2 damping_nspm{0.0};
};

/// Hirschberg, Rill and Weinfurter 2007: rational rise to the maximum, cubic fall to sliding,
/// quadratic in load between the two given loads, both directions joined through a normalised slip.
/// Friction scales force and slip of the maximum and leaves the initial slope.
TyreForce load_sensitive_force(const TyreParameters& tyre, const TyreContact& contact);

/// Magic Formula of the CommonRoad vehicle models with combined slip. One published slip is mended:
/// the vertical shift of the longitudinal force stands outside the sine.
TyreForce published_force(const TyreParameters& tyre, const TyreContact& contact);

inline TyreForce steady_force(const TyreParameters& tyre, const TyreContact& contact) {
  return tyre.published ? published_force(tyre, contact) : load_sensitive_force(tyre, contact);
}

/// Advances the patch's deflection by `dt_s` and returns the force that it carries (Rill 2006, "First order tire
/// dynamics", eq. 15): (d v_T + f) dy/dt = v_T (F(s) − c y), force c y + d dy/dt; implicit in y, so stable at every
/// speed. The force never exceeds the surface's limit.
Vec2 relax(const TyreForce& steady, double most_force_n, double dt_s, Vec2& deflection_m);

}  // namespace septet::vehicle

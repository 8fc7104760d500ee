#pragma once
/// What an impact gives back of the closing speed.
///
/// e(v) = e∞ + (e0 − e∞) exp(−v/v0): bumpers and fenders spring back from a touch, a crushed front hardly does. 0.48 at
/// 1 m/s, 0.22 at 5, 0.13 at 10, 0.11 at 15.6 (56 km/h, a wall). The values and their sources stand in impact.toml.

namespace septet::impact {

/// `closing_mps`: speed at which the two surfaces approach along the normal; a negative one counts as 0.
double restitution(double closing_mps);

/// Friction between the bodies of two vehicles.
double vehicle_friction();

/// Radius of a vehicle's corners in plan.
double vehicle_corner_m();

/// Stiffness of a body at a trunk or a post, against that at a wall.
double post_stiffness_share();

}  // namespace septet::impact

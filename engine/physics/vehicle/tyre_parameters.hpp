#pragma once
/// Parameters of the two tyres: the one that cars drive on, and the published one that verifies the chassis.

namespace septet::vehicle {

/// Force characteristic along one direction of the contact, at one wheel load (Hirschberg, Rill and
/// Weinfurter 2007, "Tire model TMeasy", fig. 4): initial slope, maximum and full sliding.
struct SlipCurve {
  double slope_n = 0.0;    ///< dF/ds at zero slip, N per unit of slip.
  double peak_slip = 0.1;  ///< Slip at the maximum force.
  double peak_force_n = 0.0;
  double sliding_slip = 0.5;  ///< From here on the whole contact slides.
  double sliding_force_n = 0.0;
};

/// The tyre that cars drive on: load-sensitive, combined slip, relaxation, aligning torque.
struct LoadSensitiveTyre {
  double nominal_load_n = 0.0;
  SlipCurve longitudinal_nominal,
      longitudinal_double;  ///< At the nominal load and at twice the nominal load.
  SlipCurve lateral_nominal, lateral_double;
  double trail_over_length = 0.0;  ///< Pneumatic trail over contact length at zero slip and nominal load.
  double trail_zero_slip = 0.2;    ///< Lateral slip at which the trail vanishes.
  double camber_slip = 0.0;        ///< Lateral slip that gives the same force as one radian of inclination.
  /// Stiffness of the standing contact patch against the rim; sets the relaxation length.
  double longitudinal_stiffness_npm = 0.0;
  double lateral_stiffness_npm = 0.0;
  double longitudinal_damping_nspm = 0.0;
  double lateral_damping_nspm = 0.0;
};

/// Magic Formula as in CommonRoad vehicle models 3.0.2 (M. Althoff and G. Würsching 2020, appendix): forces
/// proportional to load. Names of the coefficients are those of Pacejka. Without aligning torque.
struct PublishedTyre {
  double p_cx1 = 0, p_dx1 = 0, p_dx3 = 0, p_ex1 = 0, p_kx1 = 0, p_hx1 = 0, p_vx1 = 0;
  double r_bx1 = 0, r_bx2 = 0, r_cx1 = 0, r_ex1 = 0, r_hx1 = 0;
  double p_cy1 = 0, p_dy1 = 0, p_dy3 = 0, p_ey1 = 0, p_ky1 = 0, p_hy1 = 0, p_hy3 = 0, p_vy1 = 0, p_vy3 = 0;
  double r_by1 = 0, r_by2 = 0, r_by3 = 0, r_cy1 = 0, r_ey1 = 0, r_hy1 = 0;
  double r_vy1 = 0, r_vy3 = 0, r_vy4 = 0, r_vy5 = 0, r_vy6 = 0;
  double relaxation_length_m = 0.05;  ///< Not published; short against every manoeuvre, long enough for a step of 1 ms.
};

struct TyreParameters {
  bool published = false;  ///< Selects one of the two below.
  LoadSensitiveTyre load_sensitive;
  PublishedTyre magic_formula;
  double reference_friction = 0.9;  ///< Friction of the surface on which the forces above hold.
  double radius_m = 0.0;            ///< Unloaded.
  double rim_radius_m = 0.0;        ///< Radius of the flange, the rim's outermost part.
  double vertical_stiffness_npm = 0.0;
  double vertical_damping_nspm = 0.0;
  double rolling_resistance = 0.0;        ///< Force over load at walking speed.
  double rolling_resistance_s2pm2 = 0.0;  ///< Its growth with the square of speed.
};

}  // namespace septet::vehicle

#pragma once
/// Parameters of a car. Plain data; read from TOML by read_vehicle.hpp.
///
/// Vehicle frame: x forward, y left, z up, origin on the ground below the middle of the rear axle. Travel of a wheel is
/// positive in bump (wheel up against the body) and zero at rest on level ground. Camber is positive with the wheel's
/// top outward, toe positive with its front inward; tables are given for one wheel and mirrored for the other.

#include <array>
#include <cstdint>

#include "engine/math/gravity.hpp"
#include "engine/physics/vehicle/ground.hpp"
#include "engine/physics/vehicle/table.hpp"
#include "engine/physics/vehicle/tyre_parameters.hpp"

namespace septet::vehicle {

inline constexpr int axle_count = 2;  ///< Front, rear.

struct BodyParameters {
  double mass_kg = 0.0;  ///< Whole car with driver.
  double wheelbase_m = 0.0;
  double mass_centre_x_m = 0.0;  ///< Place of the sprung mass, from the rear axle forward.
  double mass_centre_z_m = 0.0;  ///< Height of the sprung mass, above the ground at rest.
  Vec3 inertia_kgm2{0.0};        ///< Roll and pitch of the sprung mass, yaw of the whole car.
  double length_m = 0.0, width_m = 0.0, height_m = 0.0, rear_overhang_m = 0.0;
  double drag_area_m2 = 0.0;  ///< Drag coefficient times frontal area.
  std::array<double, axle_count> lift_area_m2{};
};

/// Kinematics and compliance of one axle's wheels.
struct SuspensionParameters {
  double track_m = 0.0;
  bool rigid_axle = false;          ///< The wheels lean together, joined to the body in one point.
  double unsprung_mass_kg = 0.0;    ///< Per wheel.
  double wheel_inertia_kgm2 = 0.0;  ///< About the spin axis, of all parts that turn with the wheel.
  Table spring_force_n;             ///< At the wheel, above the static load, over travel; includes the bump
                                    ///< stops.
  Table damper_force_n;             ///< At the wheel, over the rate of travel.
  double anti_roll_npm = 0.0;       ///< Force at each wheel per metre of difference of travel, left against right.
  Table camber_rad, toe_rad;        ///< Over travel.
  /// Slopes of the paths of contact and wheel centre over travel, outward and forward. The contact's lateral slope is
  /// the height of the roll centre over half the track; the longitudinal slopes are anti-dive (contact: braking) and
  /// anti-squat (centre: driving).
  Table contact_lateral_slope, contact_longitudinal_slope;
  Table centre_lateral_slope, centre_longitudinal_slope;
  /// Compliance: steer away from the force, that is, understeer in front.
  double toe_out_by_lateral_force_radpn = 0.0;
  double steer_by_aligning_torque_radpnm = 0.0;
  double camber_by_lateral_force_radpn = 0.0;
  double contact_by_lateral_force_mpn = 0.0;  ///< Shift of the contact sideways under the wheel.
};

struct SteeringParameters {
  double ratio = 1.0;      ///< Hand wheel over mean road-wheel angle.
  double lock_rad = 7.85;  ///< Lock of the hand wheel.
  double ackermann = 0.0;  ///< 0 parallel, 1 geometrically exact.
  double mechanical_trail_m = 0.0;
  double scrub_radius_m = 0.0;           ///< Positive outside the kingpin axis.
  double column_stiffness_nmprad = 0.0;  ///< Hand wheel against rack, at the hand wheel; 0 is rigid.
  double rack_damping_nmsprad = 0.0;     ///< At the hand wheel.
  double friction_nm = 0.0;              ///< At the hand wheel.
  double centring_nmprad = 0.0;          ///< Centring by the kingpin inclination, at the road wheels, both sides.
  Table assistance;                      ///< Share of the torque that the power steering carries, over speed in m/s.
};

enum class Transmission : std::uint8_t {
  direct,     ///< Drive without an engine: pedal to wheel torque, for cars that are published without one.
  automatic,  ///< Torque converter with lock-up and stepped gears.
  manual,     ///< Clutch and stepped gears; a clutch pedal, or a robot where the selector says
              ///< `drive`.
};

struct PowertrainParameters {
  static constexpr int most_gears = 8;
  Transmission transmission = Transmission::direct;
  double front_share = 1.0;  ///< Front share of the drive torque: 1 front-wheel drive, 0 rear-wheel drive.
  // direct
  double direct_acceleration_mps2 = 0.0;  ///< At full pedal, up to the speed below; constant power beyond it.
  double direct_power_speed_mps = 1.0;
  // engine
  Table full_torque_nm,
      closed_torque_nm;  ///< At the crankshaft over rad/s: throttle open, throttle closed.
  int cylinders = 4;
  double engine_inertia_kgm2 = 0.0;
  double idle_radps = 0.0, most_radps = 0.0;
  double torque_lag_s = 0.0;
  // converter: over speed ratio turbine/pump
  Table converter_capacity;         ///< Pump torque over the square of pump speed, N m s².
  Table converter_ratio;            ///< Turbine torque over pump torque.
  int lowest_lockup_gear = 0;       ///< 0: never.
  double lockup_speed_radps = 0.0;  ///< Turbine speed from which the lock-up clutch closes.
  double clutch_capacity_nm = 0.0;  ///< Capacity of the lock-up clutch or of the manual car's clutch.
  // gears
  int gear_count = 0;
  std::array<double, most_gears> gear_ratio{};
  double reverse_ratio = 0.0, final_ratio = 1.0;
  double efficiency = 1.0;
  double shift_time_s = 0.0;
  double upshift_closed_radps = 0.0,
         upshift_open_radps = 0.0;  ///< Gearbox input speed to shift up at, by pedal.
  double downshift_closed_radps = 0.0, downshift_open_radps = 0.0;
};

struct BrakeParameters {
  std::array<double, axle_count> full_torque_nm{};  ///< Per wheel at full pedal.
  double parking_torque_nm = 0.0;                   ///< Per rear wheel.
  double lag_s = 0.05;
  bool anti_lock = false, traction_control = false, stability_control = false;
  double anti_lock_slip = 0.12;      ///< Slip that the anti-lock system aims at.
  double understeer_radps2pm = 0.0;  ///< Gradient that the stability control expects, rad per m/s².
};

struct VehicleParameters {
  BodyParameters body;
  std::array<SuspensionParameters, axle_count> suspension;
  TyreParameters tyre;
  SteeringParameters steering;
  PowertrainParameters powertrain;
  BrakeParameters brakes;
  /// Verification only: the published equations' simplifications, described in published_chassis.hpp and measured in
  /// vehicles/README.md.
  bool as_published = false;
};

}  // namespace septet::vehicle

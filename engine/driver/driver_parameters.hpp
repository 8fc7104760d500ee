#pragma once
/// A simulated driver's named parameters, and the sets for kinds of drivers.
///
/// None is fitted to a histogram or a participant; README.md has the findings behind the difference of novices and
/// experienced drivers. The steering gains follow from the driver's knowledge of the car and the natural frequency and
/// damping of lane keeping; noise and delays are of the size in the literature (README.md beside this file).

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::driver {

/// The driver's knowledge of the car, from experience.
struct CarKnowledge {
  double steering_ratio = 16.0;
  double wheelbase_m = 2.8;
  double understeer_radps2pm = 0.005;        ///< Road-wheel angle per lateral acceleration beyond the geometric one.
  double power_per_mass_wpkg = 72.0;         ///< At the wheels.
  double strongest_acceleration_mps2 = 3.5;  ///< In low gears.
  double drag_per_speed2_pm = 2.1e-4;        ///< Deceleration by air per speed squared.
  double rolling_drag_mps2 = 0.12;
  double strongest_braking_mps2 = 9.5;  ///< At full pedal.
  bool has_clutch = false;              ///< A manual gearbox…
  int gears = 5;                        ///< …with this many, and the engine's speed in each.
  std::array<double, 8> engine_radps_per_mps{};
};

/// Two-point visual steering.
struct SteeringParameters {
  double natural_frequency_radps = 0.6;  ///< Frequency of returning to the lane's middle.
  double damping = 0.9;
  double integral_per_s = 0.12;        ///< Weight of the lasting error against the present one.
  double near_distance_m = 10.0;       ///< Salvucci and Gray's near point…
  double far_time_s = 2.0;             ///< …and far point.
  double near_angle_limit_rad = 0.03;  ///< Limit of the near angle that counts as lasting error.
  double delay_s = 0.20;               ///< From eye to hand.
  double hand_lag_s = 0.10;
  double largest_rate_radps = 6.0;
  double peripheral_share = 0.6;  ///< Share of the road's changes that is acted upon while looking elsewhere.
  double position_noise_m = 0.19,
         position_noise_s = 2.5;  ///< SD and correlation time of the perceived place in the lane.
  double heading_noise_rad = 0.0018, heading_noise_s = 0.6;
};

/// Speed and gap: the improved intelligent driver model behind a reaction time.
struct SpeedParameters {
  double limit_factor = 1.0;        ///< Desired speed over the limit.
  double desired_speed_mps = 33.3;  ///< Without a posted limit.
  double on_snow = 0.8;             ///< Share of it on a road under snow.
  double time_gap_s = 1.5;
  double acceleration_mps2 = 1.6, braking_mps2 = 2.0;
  double standstill_gap_m = 3.0;
  double coolness = 0.99;  ///< Trust that the one ahead keeps its acceleration.
  double reaction_time_s = 0.7;
  double distance_noise = 0.06,
         noise_s = 8.0;            ///< Relative SD of perceived distances, correlation time.
  double speed_noise = 0.015;      ///< Relative SD of the perceived own speed.
  double largest_jerk_mps3 = 2.5;  ///< Limit on the desired acceleration's change, except in an emergency.
  double preview_s = 10.0;         ///< A leader farther ahead than this, over one's own speed, is ignored.
  double warned_gap_m = 3.0;       ///< Extra beyond the standstill gap to a leader with hazard lights.
  double warns_after_s = 6.0, warns_spread = 0.4;  ///< Own hazard lights behind it: median, and SD of its logarithm.
};

struct LaneChoiceParameters {
  double threshold_mps2 = 0.25;        ///< Gain that justifies a change.
  double follow_ambulance_mps2 = 0.7;  ///< Value of the ambulance's lane.
  double in_tracks_within_m = 0.0;     ///< Distance up to which an ambulance ahead is followed in its tracks; 0: never.
  double keep_out_mps2 = 0.3;          ///< Value of one lane further from the middle of the road.
  double accepted_gap = 0.5;           ///< Time gap that a change may leave, ahead and behind, over the driver's own.
  double safe_braking_mps2 = 1.5;      ///< Largest braking that a change may impose on anyone.
  double strictness_underway = 0.6;    ///< Factor on both once the car moves over: below this the driver goes back.
  double signal_s = 1.5;               ///< Indicator before the wheel turns.
  double looks_again = 1.0;            ///< Probability of another look into the mirror before that.
  double duration_s = 5.0;
  double pause_s = 4.0;  ///< Between two changes.
};

struct MirrorParameters {
  double interval_s = 8.0;  ///< Mean time between glances without a manoeuvre.
  double glance_s = 0.7, glance_spread = 0.3,
         longest_glance_s = 1.4;  ///< Median duration, and SD of its logarithm.
  double ease_m = 0.5;            ///< Nearer than this to the path, the driver feels free to look away.
  double turn_s = 0.25;           ///< Head to the mirror, or back.
};

/// Bends, limits ahead, and lines where others may have right of way.
struct CourseParameters {
  double bend_mps2 = 2.4;         ///< Comfortable lateral acceleration in a bend…
  double lead_s = 4.5;            ///< …time before it at which he wants to be slow enough…
  double ease_off_mps2 = 1.0;     ///< …and his deceleration for it, or for a lower limit.
  double gap_s = 3.6;             ///< Gap to the arrival of one with right of way that the driver accepts…
  double judgement = 0.10;        ///< …judged with a wandering error of this relative SD.
  double judgement_time_s = 2.0;  ///< Its correlation time.
  double turn_signal_s = 2.2;     ///< Indicator before a turn.
  double preview_m = 120.0;       ///< Preview of bends and limits.
  double crossing_mps = 100.0;    ///< Towards a crossing with a person at its edge.
};

/// Clutch and lever of a manual gearbox; engine speeds as the driver hears them, at light and at full accelerator.
struct GearParameters {
  double up_light_radps = 235.0, up_full_radps = 580.0;  ///< 2,250 and 5,550 a minute.
  double down_light_radps = 125.0, down_full_radps = 260.0;
  double clutch_in_radps = 85.0;   ///< Below this the clutch goes down, before the engine stalls.
  double drive_off_radps = 165.0;  ///< Kept while the clutch bites.
  double drive_off_accelerator = 0.2;
  double bite_rate_ps = 0.5;  ///< Clutch travel a second, through the bite.
  double press_s = 0.20, lever_s = 0.35, release_s = 0.50;
  double pause_s = 1.0;  ///< Between two changes.
};

struct DriverParameters {
  std::string name = "plain";
  CarKnowledge car;
  SteeringParameters steering;
  SpeedParameters speed;
  GearParameters gears;
  LaneChoiceParameters lanes;
  MirrorParameters mirrors;
  CourseParameters course;
};

struct NamedDriver {
  std::string_view name, description;
};
/// All available drivers.
std::vector<NamedDriver> simulated_drivers();

/// The same driver while playing a game behind an ambulance: its lane is worth more, smaller gaps are accepted, changes
/// are quicker and follow one another sooner, and the speed is higher. Half, double and three fifths were chosen by the
/// paper's report of its participants (seeds 3 and 4).
DriverParameters playing(DriverParameters driver);

/// Error: no such driver, with the list of drivers.
Expected<DriverParameters> find_driver(std::string_view name);

}  // namespace septet::driver

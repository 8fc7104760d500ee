#pragma once
/// Who the simulated driver is: a few named parameters, and the sets that stand for kinds of
/// drivers.
///
/// None is fitted to a histogram or a participant; what tells novices and experienced drivers apart has its findings in
/// README.md. The steering gains follow from the driver's
/// knowledge of the car and the natural frequency and damping with which they keep the lane; noise
/// and delays are of the size that the literature names (README.md beside this file).

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::driver {

/// What the driver knows of the car from having driven it.
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
  int gears = 5;                        ///< …of so many, and what the engine turns at in each.
  std::array<double, 8> engine_radps_per_mps{};
};

/// Two-point visual steering.
struct SteeringParameters {
  double natural_frequency_radps = 0.6;  ///< Of returning to the lane's middle.
  double damping = 0.9;
  double integral_per_s = 0.12;        ///< Weight of the lasting error against the present one.
  double near_distance_m = 10.0;       ///< Salvucci and Gray's near point…
  double far_time_s = 2.0;             ///< …and far point.
  double near_angle_limit_rad = 0.03;  ///< The most that counts as lasting error.
  double delay_s = 0.20;               ///< From eye to hand.
  double hand_lag_s = 0.10;
  double largest_rate_radps = 6.0;
  double peripheral_share = 0.6;  ///< Of what changes on the road, answered while looking elsewhere.
  double position_noise_m = 0.19,
         position_noise_s = 2.5;  ///< Of the perceived place in the lane: SD, correlation time.
  double heading_noise_rad = 0.0018, heading_noise_s = 0.6;
};

/// Speed and gap: the improved intelligent driver model behind a reaction time.
struct SpeedParameters {
  double limit_factor = 1.0;        ///< Desired speed over the limit.
  double desired_speed_mps = 33.3;  ///< Where no limit is posted.
  double on_snow = 0.8;             ///< Share of it on a road under snow.
  double time_gap_s = 1.5;
  double acceleration_mps2 = 1.6, braking_mps2 = 2.0;
  double standstill_gap_m = 3.0;
  double coolness = 0.99;  ///< Trust that the one ahead keeps its acceleration.
  double reaction_time_s = 0.7;
  double distance_noise = 0.06,
         noise_s = 8.0;            ///< Relative SD of perceived distances, correlation time.
  double speed_noise = 0.015;      ///< Relative SD of the perceived own speed.
  double largest_jerk_mps3 = 2.5;  ///< Of the wish, unless it is an emergency.
  double preview_s = 10.0;         ///< Who is farther ahead than this, over one's own speed, is not minded yet.
  double warned_gap_m = 3.0;       ///< Left beyond the standstill gap to who warns by hazard lights.
  double warns_after_s = 6.0, warns_spread = 0.4;  ///< Own hazard lights behind him: median, and SD of its logarithm.
};

struct LaneChoiceParameters {
  double threshold_mps2 = 0.25;        ///< Gain for which a change is worth it.
  double follow_ambulance_mps2 = 0.7;  ///< Worth of being in the ambulance's lane.
  double in_tracks_within_m = 0.0;     ///< How near an ambulance ahead is followed in its tracks; 0: never.
  double keep_out_mps2 = 0.3;          ///< Worth of one lane further from the middle of the road.
  double accepted_gap = 0.5;           ///< Time gap that a change may leave, ahead and behind, over the driver's own.
  double safe_braking_mps2 = 1.5;      ///< The most that a change may ask of anybody.
  double strictness_underway = 0.6;    ///< Of both, once the car moves over: below this the driver goes back.
  double signal_s = 1.5;               ///< Indicator before the wheel turns.
  double looks_again = 1.0;            ///< How probably the mirror is looked into once more before that.
  double duration_s = 5.0;
  double pause_s = 4.0;  ///< Between two changes.
};

struct MirrorParameters {
  double interval_s = 8.0;  ///< Mean time between glances that no manoeuvre calls for.
  double glance_s = 0.7, glance_spread = 0.3,
         longest_glance_s = 1.4;  ///< Median duration, and SD of its logarithm.
  double ease_m = 0.5;            ///< Nearer than this to the path, the driver feels free to look away.
  double turn_s = 0.25;           ///< Head to the mirror, or back.
};

/// Bends, limits ahead, and lines where others may have right of way.
struct CourseParameters {
  double bend_mps2 = 2.4;         ///< Sideways, that the driver is at ease with in a bend…
  double lead_s = 4.5;            ///< …so long before which he wants to be slow enough…
  double ease_off_mps2 = 1.0;     ///< …and how he slows down for it, or for a lower limit.
  double gap_s = 3.6;             ///< Until who has right of way comes, for which the driver does not wait…
  double judgement = 0.10;        ///< …judged with an error of this relative SD, that wanders.
  double judgement_time_s = 2.0;  ///< Its correlation time.
  double turn_signal_s = 2.2;     ///< Indicator before a turn.
  double preview_m = 120.0;       ///< How far ahead bends and limits are looked for.
  double crossing_mps = 100.0;    ///< Towards a crossing at whose edge somebody stands.
};

/// Clutch and lever of a manual gearbox; engine speeds as the driver hears them, with little
/// accelerator and with all of it.
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
/// Whom there is to choose from.
std::vector<NamedDriver> simulated_drivers();

/// The same driver while playing a game behind an ambulance: its lane is worth more, smaller gaps do, one change soon follows another, and
/// nobody dawdles. Half, double and three fifths were chosen by what the paper reports of its people (seeds 3 and 4).
DriverParameters playing(DriverParameters driver);

/// Error: there is no such driver, and who there is.
Expected<DriverParameters> find_driver(std::string_view name);

}  // namespace septet::driver

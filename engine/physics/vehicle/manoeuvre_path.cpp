#include <algorithm>
#include <cmath>

#include "engine/math/angle_units.hpp"
#include "engine/physics/vehicle/manoeuvre_car.hpp"

// Double lane change (ISO 3888-1) and sine with dwell (ISO 19365).

namespace septet::vehicle {
namespace {

constexpr double pi = 3.141592653589793;

/// Middle of the lanes of ISO 3888-1: 15 m straight, 30 m over, 25 m beside, 25 m back, 30 m straight. The lanes' edges
/// lie 3.5 m apart; the second lane is 0.1 car widths wider than the first, so that its middle lies further out.
double lane_change_path_m(double x_m, double width_m) {
  const double offset_m = 3.5 + 0.05 * width_m;
  const auto rise = [](double part) {
    const double p = std::clamp(part, 0.0, 1.0);
    return p * p * p * (10.0 + p * (-15.0 + 6.0 * p));
  };
  return offset_m * (rise((x_m - 15.0) / 30.0) - rise((x_m - 70.0) / 25.0));
}

}  // namespace

ManoeuvreReport double_lane_change(const VehicleParameters& parameters, const ManoeuvreOptions& options) {
  constexpr double preview_s = 0.6, lag_s = 0.05, most_rate_radps = 0.4;
  constexpr double driver_understeer = 0.0025;  // Understeer expected by the driver, rad per m/s².
  constexpr double run_up_m = 60.0, length_m = 140.0;
  const double speed_mps = options.speed_mps > 0.0 ? options.speed_mps : 80.0 / 3.6;
  ManoeuvreCar car(parameters, options, speed_mps);
  car.begin();
  const double width_m = parameters.body.width_m;
  double steer_rad = 0.0;
  double peak_mps2 = 0.0, peak_sideslip_rad = 0.0, peak_yaw_radps = 0.0, peak_roll_rad = 0.0;
  double worst_m = 0.0, peak_steer_rad = 0.0, least_load_n = 1e9;
  while (car.time_s() < 20.0) {
    car.record();
    const ManoeuvreSample now = car.sample();
    const double x_m = now.x_m - run_up_m;
    if (x_m > length_m) break;
    if (x_m > 0.0 && x_m < 125.0) {
      peak_mps2 = std::max(peak_mps2, std::abs(now.lateral_acceleration_mps2));
      peak_sideslip_rad = std::max(peak_sideslip_rad, std::abs(now.sideslip_rad));
      peak_yaw_radps = std::max(peak_yaw_radps, std::abs(now.yaw_rate_radps));
      peak_roll_rad = std::max(peak_roll_rad, std::abs(now.roll_rad));
      peak_steer_rad = std::max(peak_steer_rad, std::abs(now.steer_rad));
      worst_m = std::max(worst_m, std::abs(now.y_m - lane_change_path_m(x_m, width_m)));
      least_load_n = std::min(least_load_n, now.least_wheel_load_n);
    }
    const double ahead_m = now.speed_mps * preview_s;
    const double target_x_m = x_m + ahead_m * std::cos(now.heading_rad);
    const double target_y_m = now.y_m + ahead_m * std::sin(now.heading_rad);
    const double error_m = lane_change_path_m(target_x_m, width_m) - target_y_m;
    const double wanted_rad = 2.0 * error_m / (ahead_m * ahead_m) *
                              (parameters.body.wheelbase_m + driver_understeer * now.speed_mps * now.speed_mps);
    const double rate = std::clamp((wanted_rad - steer_rad) / lag_s, -most_rate_radps, most_rate_radps);
    steer_rad += rate * manoeuvre_step_s;
    car.advance(steer_rad);
  }
  return {"double-lane-change",
          "ISO 3888-1",
          {{"entry speed", speed_mps * 3.6, "km/h"},
           {"exit speed", car.sample().speed_mps * 3.6, "km/h"},
           {"peak lateral acceleration", peak_mps2, "m/s2"},
           {"peak sideslip", peak_sideslip_rad * degrees_per_radian, "deg"},
           {"peak yaw rate", peak_yaw_radps * degrees_per_radian, "deg/s"},
           {"peak roll", peak_roll_rad * degrees_per_radian, "deg"},
           {"peak steer", peak_steer_rad, "rad"},
           {"worst distance from the path", worst_m, "m"},
           {"least wheel load", least_load_n, "N"}},
          car.series()};
}

ManoeuvreReport sine_with_dwell(const VehicleParameters& parameters, const ManoeuvreOptions& options) {
  constexpr double frequency_hz = 0.7, dwell_s = 0.5;
  constexpr double amplitude_factor = 5.0;
  const double speed_mps = options.speed_mps > 0.0 ? options.speed_mps : 80.0 / 3.6;
  double amplitude_rad = options.steer_rad;
  if (amplitude_rad == 0.0) {
    ManoeuvreOptions slow = options;
    slow.speed_mps = speed_mps;
    const ManoeuvreReport circle = steady_circle(parameters, slow);
    amplitude_rad =
        amplitude_factor * first_crossing(
                               circle.series, [](const ManoeuvreSample& s) { return s.lateral_acceleration_mps2; },
                               0.3 * gravity_mps2, [](const ManoeuvreSample& s) { return s.steer_rad; });
  }
  ManoeuvreOptions with_control = options;
  with_control.stability_control = options.stability_control.value_or(true);
  ManoeuvreCar car(parameters, with_control, speed_mps);
  car.begin();
  car.input().accelerator = 0.0;
  const double dwell_begin_s = 0.75 / frequency_hz, dwell_end_s = dwell_begin_s + dwell_s;
  const double end_s = 1.0 / frequency_hz + dwell_s;
  double peak_yaw_radps = 0.0, displacement_m = 0.0, yaw_after_1_s = 0.0, yaw_after_1_75_s = 0.0;
  double peak_sideslip_rad = 0.0;
  while (car.time_s() < end_s + 3.0) {
    car.record();
    const double t = car.time_s();
    const double phase_s = t < dwell_begin_s ? t : t < dwell_end_s ? dwell_begin_s : t - dwell_s;
    car.advance(t < end_s ? amplitude_rad * std::sin(2.0 * pi * frequency_hz * phase_s) : 0.0);
    const ManoeuvreSample now = car.sample();
    // The second peak, to the right, is the reference of the yaw rate ratios (ISO 19365, 9).
    if (t > 0.5 / frequency_hz && t < end_s) peak_yaw_radps = std::min(peak_yaw_radps, now.yaw_rate_radps);
    peak_sideslip_rad = std::max(peak_sideslip_rad, std::abs(now.sideslip_rad));
    if (t < 1.07) displacement_m = now.y_m;
    if (t < end_s + 1.0) yaw_after_1_s = now.yaw_rate_radps;
    if (t < end_s + 1.75) yaw_after_1_75_s = now.yaw_rate_radps;
  }
  return {"sine-with-dwell",
          "ISO 19365",
          {{"speed", speed_mps * 3.6, "km/h"},
           {"amplitude", amplitude_rad, "rad"},
           {"second yaw rate peak", peak_yaw_radps * degrees_per_radian, "deg/s"},
           {"yaw rate ratio after 1 s", yaw_after_1_s / peak_yaw_radps * 100.0, "%"},
           {"yaw rate ratio after 1.75 s", yaw_after_1_75_s / peak_yaw_radps * 100.0, "%"},
           {"lateral displacement at 1.07 s", displacement_m, "m"},
           {"peak sideslip", peak_sideslip_rad * degrees_per_radian, "deg"}},
          car.series()};
}

}  // namespace septet::vehicle

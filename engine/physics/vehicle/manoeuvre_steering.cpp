#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "engine/math/angle_units.hpp"
#include "engine/physics/vehicle/manoeuvre_car.hpp"

// Steady circle (ISO 4138) and step steer (ISO 7401).

namespace septet::vehicle {
namespace {

double lateral(const ManoeuvreSample& s) { return s.lateral_acceleration_mps2; }
double steer(const ManoeuvreSample& s) { return s.steer_rad; }

/// Slope of a quantity over lateral acceleration by least squares, between 1 and 3 m/s².
double slope(const std::vector<ManoeuvreSample>& series, double (*quantity)(const ManoeuvreSample&)) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const ManoeuvreSample& s : series) {
    const double x = lateral(s), y = quantity(s);
    if (x < 1.0) continue;
    if (x > 3.0) break;
    n += 1;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return n < 2 ? 0.0 : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

template <class Quantity>
double mean_over(const std::vector<ManoeuvreSample>& series, double from_s, double to_s, const Quantity& quantity) {
  double sum = 0.0, n = 0.0;
  for (const ManoeuvreSample& s : series)
    if (s.time_s >= from_s && s.time_s <= to_s) {
      sum += quantity(s);
      n += 1.0;
    }
  return n > 0.0 ? sum / n : 0.0;
}

}  // namespace

ManoeuvreReport steady_circle(const VehicleParameters& parameters, const ManoeuvreOptions& options) {
  constexpr double most_steer_rad = 0.12;
  const double speed_mps = options.speed_mps > 0.0 ? options.speed_mps : 100.0 / 3.6;
  // Lateral acceleration grows by about 0.1 m/s² a second, the standard's limit.
  const double rate_radps = 0.1 * (parameters.body.wheelbase_m / (speed_mps * speed_mps) + 0.001);
  ManoeuvreCar car(parameters, options, speed_mps);
  car.begin();
  car.hold_gear();  // A kick-down in the bend would be another test.
  double peak_mps2 = 0.0;
  while (car.time_s() * rate_radps < most_steer_rad) {
    car.record();
    car.hold_speed(speed_mps);
    car.advance(car.time_s() * rate_radps);
    const ManoeuvreSample now = car.sample();
    peak_mps2 = std::max(peak_mps2, now.lateral_acceleration_mps2);
    const bool sliding =
        (peak_mps2 > 2.0 && now.lateral_acceleration_mps2 < peak_mps2 - 1.0) || std::abs(now.sideslip_rad) > 0.3;
    if (now.least_wheel_load_n <= 0.0 || sliding) break;
  }
  const auto& series = car.series();
  const double wheelbase_m = parameters.body.wheelbase_m;
  const double understeer = slope(series, steer) - wheelbase_m / (speed_mps * speed_mps);
  const auto at = [&](double acceleration, auto quantity) {
    return first_crossing(series, lateral, acceleration, quantity);
  };
  const auto yaw_gain = [](const ManoeuvreSample& s) { return s.yaw_rate_radps / s.steer_rad; };
  ManoeuvreReport report{
      "steady-circle",
      "ISO 4138, constant speed",
      {{"speed", speed_mps * 3.6, "km/h"},
       {"understeer gradient", understeer * degrees_per_radian * gravity_mps2, "deg/g"},
       {"yaw gain at 2 m/s2", at(2.0, yaw_gain), "1/s"},
       {"yaw gain at 4 m/s2", at(4.0, yaw_gain), "1/s"},
       {"steer at 4 m/s2", at(4.0, steer), "rad"},
       {"sideslip gradient",
        slope(series, [](const ManoeuvreSample& s) { return s.sideslip_rad; }) * degrees_per_radian, "deg/(m/s2)"},
       {"sideslip at 4 m/s2", at(4.0, [](const ManoeuvreSample& s) { return s.sideslip_rad; }) * degrees_per_radian,
        "deg"},
       {"roll gradient",
        slope(series, [](const ManoeuvreSample& s) { return s.roll_rad; }) * degrees_per_radian * gravity_mps2,
        "deg/g"},
       {"hand wheel torque at 4 m/s2", at(4.0, [](const ManoeuvreSample& s) { return s.steering_torque_nm; }), "N m"},
       {"peak lateral acceleration", peak_mps2, "m/s2"}},
      series};
  if (peak_mps2 < 4.0)
    report.faults.push_back(fmt::format(
        "4 m/s2 was not reached: the most was {:.2f}, so what is said of 2 and 4 m/s2 is the last value", peak_mps2));
  return report;
}

ManoeuvreReport step_steer(const VehicleParameters& parameters, const ManoeuvreOptions& options) {
  constexpr double rate_radps = 0.4;
  constexpr double wanted_mps2 = 4.0;
  const double speed_mps = options.speed_mps > 0.0 ? options.speed_mps : 80.0 / 3.6;
  double steer_rad = options.steer_rad;
  if (steer_rad == 0.0) {
    ManoeuvreOptions slow = options;
    slow.speed_mps = speed_mps;
    steer_rad = steady_circle(parameters, slow).figure("steer at 4 m/s2");
  }
  // Response times and overshoots are those of the side of the steering.
  const double side = steer_rad < 0.0 ? -1.0 : 1.0;
  const double steered_s = std::abs(steer_rad) / rate_radps;
  ManoeuvreCar car(parameters, options, speed_mps);
  car.begin();
  while (car.time_s() < 6.0) {  // The throttle keeps its position of straight running.
    car.record();
    car.advance(side * std::min(std::abs(steer_rad), car.time_s() * rate_radps));
  }
  const auto& series = car.series();
  const auto yaw = [side](const ManoeuvreSample& s) { return side * s.yaw_rate_radps; };
  const auto sideways = [side](const ManoeuvreSample& s) { return side * lateral(s); };
  const double yaw_steady = mean_over(series, 3.0, 4.0, yaw);
  const double lateral_steady = mean_over(series, 3.0, 4.0, sideways);
  // Response times count from half of the steering input (ISO 7401, 10.2).
  const double half_s = 0.5 * steered_s;
  const auto time = [](const ManoeuvreSample& s) { return s.time_s; };
  double yaw_peak = 0.0, lateral_peak = 0.0;
  for (const ManoeuvreSample& s : series) {
    yaw_peak = std::max(yaw_peak, yaw(s));
    lateral_peak = std::max(lateral_peak, sideways(s));
  }
  ManoeuvreReport report{
      "step-steer",
      "ISO 7401, step input",
      {{"speed", speed_mps * 3.6, "km/h"},
       {"wanted lateral acceleration", wanted_mps2, "m/s2"},
       {"steer", steer_rad, "rad"},
       {"steady yaw rate", side * yaw_steady, "rad/s"},
       {"steady lateral acceleration", side * lateral_steady, "m/s2"},
       {"yaw rate t90", first_crossing(series, yaw, 0.9 * yaw_steady, time) - half_s, "s"},
       {"yaw rate overshoot", (yaw_peak / yaw_steady - 1.0) * 100.0, "%"},
       {"lateral acceleration t90", first_crossing(series, sideways, 0.9 * lateral_steady, time) - half_s, "s"},
       {"lateral acceleration overshoot", (lateral_peak / lateral_steady - 1.0) * 100.0, "%"},
       {"steady sideslip",
        mean_over(series, 3.0, 4.0, [](const ManoeuvreSample& s) { return s.sideslip_rad; }) * degrees_per_radian,
        "deg"},
       {"steady roll",
        mean_over(series, 3.0, 4.0, [](const ManoeuvreSample& s) { return s.roll_rad; }) * degrees_per_radian, "deg"}},
      series};
  if (steered_s > 2.0)
    report.faults.push_back(fmt::format(
        "the steering takes {:.1f} s to its end: what is called steady is not, and response times say nothing",
        steered_s));
  return report;
}

}  // namespace septet::vehicle

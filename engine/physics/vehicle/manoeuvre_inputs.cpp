#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "engine/core/check.hpp"
#include "engine/math/angle_units.hpp"
#include "engine/physics/vehicle/manoeuvre_car.hpp"

// Given inputs; and the faults possible in every manoeuvre.

namespace septet::vehicle {
namespace {

DriverInput between(const TimedInput& before, const TimedInput& after, double time_s) {
  const double part = std::clamp((time_s - before.time_s) / (after.time_s - before.time_s), 0.0, 1.0);
  DriverInput input = before.input;
  const auto mix = [&](double DriverInput::*control) {
    input.*control = std::lerp(before.input.*control, after.input.*control, part);
  };
  for (double DriverInput::*control :
       {&DriverInput::steering_wheel_rad, &DriverInput::accelerator, &DriverInput::brake, &DriverInput::clutch})
    mix(control);
  return input;
}

double peak(const std::vector<ManoeuvreSample>& series, double ManoeuvreSample::*quantity) {
  double result = 0.0;
  for (const ManoeuvreSample& sample : series)
    if (std::abs(sample.*quantity) > std::abs(result)) result = sample.*quantity;
  return result;
}

}  // namespace

ManoeuvreReport drive_inputs(const VehicleParameters& parameters, const ManoeuvreOptions& options,
                             const std::vector<TimedInput>& rows) {
  SEPTET_CHECK(rows.size() >= 2, "{} rows", rows.size());
  ManoeuvreOptions conditions = options;
  conditions.stability_control = options.stability_control.value_or(true);
  ManoeuvreCar car(parameters, conditions, options.speed_mps);
  car.begin();
  const double begin_s = rows.front().time_s, end_s = rows.back().time_s;
  std::size_t row = 0;
  for (;;) {
    car.record();
    const double time_s = begin_s + car.time_s();
    if (time_s >= end_s) break;
    while (row + 2 < rows.size() && rows[row + 1].time_s <= time_s) ++row;
    car.input() = between(rows[row], rows[row + 1], time_s);
    car.advance(car.input().steering_wheel_rad / parameters.steering.ratio);
  }
  const auto& series = car.series();
  ManoeuvreReport report{
      "inputs",
      "given inputs",
      {{"time", car.time_s(), "s"},
       {"friction", car.friction(), ""},
       {"speed at the end", car.sample().speed_mps * 3.6, "km/h"},
       {"way ahead", car.sample().x_m, "m"},
       {"way aside", car.sample().y_m, "m"},
       {"peak yaw rate", peak(series, &ManoeuvreSample::yaw_rate_radps) * degrees_per_radian, "deg/s"},
       {"peak lateral acceleration", peak(series, &ManoeuvreSample::lateral_acceleration_mps2), "m/s2"},
       {"peak longitudinal acceleration", peak(series, &ManoeuvreSample::longitudinal_acceleration_mps2), "m/s2"},
       {"peak sideslip", peak(series, &ManoeuvreSample::sideslip_rad) * degrees_per_radian, "deg"},
       {"peak roll", peak(series, &ManoeuvreSample::roll_rad) * degrees_per_radian, "deg"}},
      series};
  find_faults(report);
  return report;
}

void find_faults(ManoeuvreReport& report) {
  constexpr double spun_rad = 1.0, turned_over_rad = 0.8;
  double sideslip_rad = 0.0, roll_rad = 0.0;
  bool finite = !report.series.empty();
  for (const ManoeuvreSample& sample : report.series) {
    finite &= std::isfinite(sample.x_m + sample.y_m + sample.speed_mps + sample.yaw_rate_radps +
                            sample.lateral_acceleration_mps2);
    sideslip_rad = std::max(sideslip_rad, std::abs(sample.sideslip_rad));
    roll_rad = std::max(roll_rad, std::abs(sample.roll_rad));
  }
  for (const Figure& figure : report.figures)
    if (!std::isfinite(figure.value)) report.faults.push_back(fmt::format("\"{}\" is not a number", figure.name));
  if (!finite) report.faults.push_back("the car's motion is not finite");
  if (sideslip_rad > spun_rad)
    report.faults.push_back(fmt::format("the car spun: {:.0f} deg of sideslip", sideslip_rad * degrees_per_radian));
  if (roll_rad > turned_over_rad)
    report.faults.push_back(fmt::format("the car turned over: {:.0f} deg of roll", roll_rad * degrees_per_radian));
}

}  // namespace septet::vehicle

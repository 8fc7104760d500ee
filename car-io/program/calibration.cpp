#include "car-io/program/calibration.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace septet::car_io {
namespace {

/// An axis by its name, in every structure that has all four.
struct Axis {
  const char* name;
  double AxisReadings::*reading;
  AxisRange CalibrationRecord::*range;
  rig::AxisCalibration rig::CarCalibration::*calibration;
};
constexpr Axis axes[] = {
    {"steering", &AxisReadings::steering, &CalibrationRecord::steering, &rig::CarCalibration::steering},
    {"accelerator", &AxisReadings::accelerator, &CalibrationRecord::accelerator, &rig::CarCalibration::accelerator},
    {"brake", &AxisReadings::brake, &CalibrationRecord::brake, &rig::CarCalibration::brake},
    {"clutch", &AxisReadings::clutch, &CalibrationRecord::clutch, &rig::CarCalibration::clutch}};

constexpr double least_travel = 0.1;      ///< Below it the axis counts as not moved.
constexpr double pedal_dead_zone = 0.02;  ///< Weight of a resting foot.

bool is_wheel(const Axis& axis) { return axis.reading == &AxisReadings::steering; }

}  // namespace

void CalibrationRecord::add(const AxisReadings& readings) {
  for (const Axis& axis : axes) {
    AxisRange& range = this->*axis.range;
    const double reading = readings.*axis.reading;
    if (reports == 0) range = {reading, reading, reading};
    range.least = std::min(range.least, reading);
    range.most = std::max(range.most, reading);
  }
  ++reports;
}

RecordedCalibration calibration_of(const CalibrationRecord& record, const rig::CarCalibration& before) {
  RecordedCalibration result{before, ""};
  for (const Axis& axis : axes) {
    const AxisRange& range = record.*axis.range;
    rig::AxisCalibration& calibration = result.calibration.*axis.calibration;
    const double travel = range.most - range.least;
    // A wheel must be turned to both sides of where it stood.
    const bool moved = is_wheel(axis) ? std::min(range.first - range.least, range.most - range.first) >= least_travel
                                      : travel >= least_travel;
    if (!moved) {
      result.unmoved += (result.unmoved.empty() ? "" : ", ") + std::string(axis.name);
      continue;
    }
    calibration.min = range.least;
    calibration.max = range.most;
    if (is_wheel(axis)) {
      calibration.centre = range.first;
    } else {
      calibration.inverted = range.most - range.first < range.first - range.least;
      calibration.dead_zone = pedal_dead_zone;
    }
  }
  return result;
}

std::string calibration_toml(const rig::CarCalibration& calibration) {
  std::string text = fmt::format("[car.calibration]\nsteering_lock_rad = {:.4f}\ngear_lever = {}\n",
                                 calibration.steering_lock_rad, calibration.gear_lever);
  for (const Axis& axis : axes) {
    const rig::AxisCalibration& values = calibration.*axis.calibration;
    const std::string centre = is_wheel(axis) ? fmt::format("centre = {:.5f}, ", values.centre) : "";
    text += fmt::format("{} = {{ min = {:.5f}, {}max = {:.5f}, dead_zone = {:.3f}, inverted = {} }}\n", axis.name,
                        values.min, centre, values.max, values.dead_zone, values.inverted);
  }
  return text;
}

}  // namespace septet::car_io

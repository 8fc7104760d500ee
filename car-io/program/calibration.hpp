#pragma once
/// Calibration of a car: the real range of its axes, recorded while a person moves them, as the TOML for the rig.

#include <string>

#include "car-io/car_layout.hpp"
#include "engine/rig/rig.hpp"

namespace septet::car_io {

/// The extremes of one axis, and its first reading: a recording begins hands off.
struct AxisRange {
  double first = 0.0, least = 0.0, most = 0.0;
};

struct CalibrationRecord {
  std::uint64_t reports = 0;
  AxisRange steering, accelerator, brake, clutch;

  void add(const AxisReadings& readings);
};

/// Calibration from the record. A pedal whose first reading lies nearer to its largest is reversed. An axis that was
/// not moved keeps `before` and is named in `unmoved`.
struct RecordedCalibration {
  rig::CarCalibration calibration;
  std::string unmoved;  ///< "clutch, brake"; empty: all were moved.
};
RecordedCalibration calibration_of(const CalibrationRecord& record, const rig::CarCalibration& before);

/// The rig's table [car.calibration].
std::string calibration_toml(const rig::CarCalibration& calibration);

}  // namespace septet::car_io

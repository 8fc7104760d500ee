#pragma once
/// Calibrating a car: how far its axes really go, recorded while somebody moves them, as the TOML
/// that belongs into the rig.

#include <string>

#include "car-io/car_layout.hpp"
#include "engine/rig/rig.hpp"

namespace septet::car_io {

/// The extremes of one axis, and its first reading: nobody touches anything when a recording
/// begins.
struct AxisRange {
  double first = 0.0, least = 0.0, most = 0.0;
};

struct CalibrationRecord {
  std::uint64_t reports = 0;
  AxisRange steering, accelerator, brake, clutch;

  void add(const AxisReadings& readings);
};

/// The calibration that the record shows. A pedal whose first reading lies nearer to its largest
/// counts the other way round. An axis that was not moved keeps `before` and is named in `unmoved`.
struct RecordedCalibration {
  rig::CarCalibration calibration;
  std::string unmoved;  ///< "clutch, brake"; empty: all were moved.
};
RecordedCalibration calibration_of(const CalibrationRecord& record, const rig::CarCalibration& before);

/// The rig's table [car.calibration].
std::string calibration_toml(const rig::CarCalibration& calibration);

}  // namespace septet::car_io

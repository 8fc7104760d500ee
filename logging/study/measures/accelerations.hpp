#pragma once
/// Acceleration, braking and cornering of the driver's car.
///
/// Longitudinal and lateral acceleration of the car's origin (middle of the rear axle) in the car's frame, as sampled:
/// neither differentiated nor smoothed. A hard braking is an unbroken run of samples at or below −`hard_braking_mps2`.

#include <span>

#include "logging/session/records.hpp"

namespace septet::logging {

struct AccelerationSettings {
  double hard_braking_mps2 = 4.0;
};

struct AccelerationMeasures {
  double longitudinal_rms_mps2 = 0.0, lateral_rms_mps2 = 0.0;
  double strongest_mps2 = 0.0, strongest_braking_mps2 = 0.0, strongest_lateral_mps2 = 0.0;  ///< All ≥ 0.
  std::size_t hard_brakings = 0;
  std::size_t samples = 0;
  std::size_t missing = 0;  ///< Samples with NaN or infinite acceleration.
};

AccelerationMeasures compute_accelerations(std::span<const Sample> samples, const AccelerationSettings& settings = {});

}  // namespace septet::logging

#include "logging/study/measures/accelerations.hpp"

#include <algorithm>
#include <cmath>

#include "logging/study/measures/sample_steps.hpp"

namespace septet::logging {

AccelerationMeasures compute_accelerations(std::span<const Sample> samples, const AccelerationSettings& settings) {
  AccelerationMeasures measures;
  double longitudinal = 0.0, lateral = 0.0;
  bool was_hard = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double along = samples[i].longitudinal_acceleration_mps2, across = samples[i].lateral_acceleration_mps2;
    if (!std::isfinite(along) || !std::isfinite(across)) {
      ++measures.missing;
      was_hard = false;
      continue;
    }
    ++measures.samples;
    longitudinal += along * along;
    lateral += across * across;
    measures.strongest_mps2 = std::max(measures.strongest_mps2, along);
    measures.strongest_braking_mps2 = std::max(measures.strongest_braking_mps2, -along);
    measures.strongest_lateral_mps2 = std::max(measures.strongest_lateral_mps2, std::abs(across));
    const bool is_hard = along <= -settings.hard_braking_mps2;
    if (is_hard && (!was_hard || !follows(samples[i - 1], samples[i]))) ++measures.hard_brakings;
    was_hard = is_hard;
  }
  if (measures.samples > 0) {
    measures.longitudinal_rms_mps2 = std::sqrt(longitudinal / static_cast<double>(measures.samples));
    measures.lateral_rms_mps2 = std::sqrt(lateral / static_cast<double>(measures.samples));
  }
  return measures;
}

}  // namespace septet::logging

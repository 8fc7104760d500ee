#include "logging/study/measures/time_to_collision.hpp"

#include <algorithm>

#include "logging/study/measures/sample_steps.hpp"

namespace septet::logging {

std::optional<double> time_to_collision_s(const Sample& sample, const TtcSettings& settings) {
  if (!sample.leader) return std::nullopt;
  const double closing_mps = sample.speed_mps - sample.leader->speed_mps;
  if (!(closing_mps >= settings.least_closing_speed_mps) || !(sample.leader->distance_gap_m >= 0.0))
    return std::nullopt;
  return sample.leader->distance_gap_m / closing_mps;
}

TtcMeasures compute_time_to_collision(std::span<const Sample> samples, const TtcSettings& settings) {
  TtcMeasures measures;
  std::optional<double> previous_s;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& sample = samples[i];
    const auto ttc_s = time_to_collision_s(sample, settings);
    if (!sample.leader) ++measures.no_leader;
    if (sample.leader && !ttc_s) ++measures.not_closing;
    if (ttc_s) {
      ++measures.samples;
      measures.smallest_s = measures.smallest_s ? std::min(*measures.smallest_s, *ttc_s) : *ttc_s;
    }
    if (ttc_s && previous_s && follows(samples[i - 1], sample) &&
        samples[i - 1].leader->participant == sample.leader->participant) {
      // Duration and area of a straight line from a to b below τ.
      const double a = settings.threshold_s - *previous_s, b = settings.threshold_s - *ttc_s;
      const double low = std::min(a, b), high = std::max(a, b);
      if (high >= 0.0) {
        const double share = low >= 0.0 ? 1.0 : high / (high - low);
        const double step_s = share * (sample.simulated_time_s - samples[i - 1].simulated_time_s);
        measures.exposed_s += step_s;
        measures.integrated_s2 += step_s * (std::max(low, 0.0) + high) / 2.0;
      }
    }
    previous_s = ttc_s;
  }
  return measures;
}

}  // namespace septet::logging

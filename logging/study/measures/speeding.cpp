#include "logging/study/measures/speeding.hpp"

#include <algorithm>

#include "engine/core/check.hpp"
#include "logging/study/measures/sample_steps.hpp"

namespace septet::logging {

SpeedingMeasures compute_speeding(std::span<const Sample> samples, std::span<const std::optional<double>> limits_mps,
                                  const SpeedingSettings& settings) {
  SEPTET_CHECK(samples.size() == limits_mps.size(), "{} samples, {} limits", samples.size(), limits_mps.size());
  SpeedingMeasures measures;
  std::size_t violations = 0;
  bool was_over = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto& limit_mps = limits_mps[i];
    ++(limit_mps ? measures.samples : measures.no_limit);
    const bool is_over = limit_mps && samples[i].speed_mps > *limit_mps + settings.tolerance_mps;
    if (is_over) {
      ++violations;
      if (!was_over || !follows(samples[i - 1], samples[i])) ++measures.episodes;
      measures.largest_excess_mps = std::max(measures.largest_excess_mps, samples[i].speed_mps - *limit_mps);
    }
    was_over = is_over;
  }
  measures.over_s = static_cast<double>(violations) * sample_interval_s;
  if (measures.samples > 0) measures.share = static_cast<double>(violations) / static_cast<double>(measures.samples);
  return measures;
}

}  // namespace septet::logging

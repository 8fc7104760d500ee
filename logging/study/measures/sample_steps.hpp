#pragma once
/// Consecutive samples: measures that difference or filter do so within unbroken runs, and fill nothing.

#include <span>
#include <vector>

#include "logging/session/records.hpp"

namespace septet::logging {

/// The nominal time from sample to sample (FORMAT.md: ten a second).
inline constexpr double sample_interval_s = 0.1;
/// Ten a second at 120 ticks a second are 0.1 s apart; a sample that is missing makes 0.2 s.
inline constexpr double longest_step_s = 0.15;

/// A longer step is a gap: no measure continues across it.
inline constexpr double longest_gap_s = 1.0;

inline bool is_gap(const Sample& before, const Sample& after) {
  const double step_s = after.simulated_time_s - before.simulated_time_s;
  return !(step_s > 0.0 && step_s <= longest_gap_s);
}

inline bool follows(const Sample& before, const Sample& after) {
  const double step_s = after.simulated_time_s - before.simulated_time_s;
  return step_s > 0.0 && step_s <= longest_step_s;
}

/// The unbroken runs of samples, in their order.
inline std::vector<std::span<const Sample>> unbroken_runs(std::span<const Sample> samples) {
  std::vector<std::span<const Sample>> runs;
  for (std::size_t begin = 0, i = 1; i <= samples.size(); ++i) {
    if (i < samples.size() && follows(samples[i - 1], samples[i])) continue;
    runs.push_back(samples.subspan(begin, i - begin));
    begin = i;
  }
  return runs;
}

}  // namespace septet::logging

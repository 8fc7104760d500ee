#include "logging/study/measures/lateral_position.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace septet::logging {
namespace {

bool is_in_lane(const Sample& sample) {
  return sample.lane != 0 && sample.lane_width_m > 0.0 && std::isfinite(sample.lane_width_m) &&
         std::isfinite(sample.lateral_position_m);
}

bool is_near(const LaneChange& change, const Sample& sample, double distance_s) {
  return std::abs(sample.simulated_time_s - change.simulated_time_s) < distance_s;
}

}  // namespace

LateralPositionStatistics compute_lateral_position_statistics(std::span<const Sample> samples,
                                                              std::span<const LaneChange> changes,
                                                              const LateralPositionSettings& settings) {
  LateralPositionStatistics result;
  double sum_of_squares = 0.0;  // Squared differences to the running mean (Welford 1962).
  for (const Sample& sample : samples) {
    if (!is_in_lane(sample)) {
      ++result.excluded_off_lane;
      continue;
    }
    if (std::ranges::any_of(changes, [&](const LaneChange& change) {
          return is_near(change, sample, settings.exclude_around_lane_change_s);
        })) {
      ++result.excluded_lane_change;
      continue;
    }
    ++result.samples;
    const double from_old_mean = sample.lateral_position_m - result.mean_m;
    result.mean_m += from_old_mean / static_cast<double>(result.samples);
    sum_of_squares += from_old_mean * (sample.lateral_position_m - result.mean_m);
  }
  const auto count = static_cast<double>(result.samples);
  if (result.samples > 0) result.sd_m = std::sqrt(sum_of_squares / count);
  if (result.samples > 1) result.sd_sample_m = std::sqrt(sum_of_squares / (count - 1.0));
  return result;
}

std::size_t LateralPositionHistogram::total() const {
  return std::accumulate(counts.begin(), counts.end(), underflow + overflow);
}

double LateralPositionHistogram::fraction(std::size_t bin) const {
  const std::size_t all = total();
  return all == 0 ? 0.0 : static_cast<double>(counts.at(bin)) / static_cast<double>(all);
}

LateralPositionHistogram compute_lateral_position_histogram(std::span<const Sample> samples) {
  using Histogram = LateralPositionHistogram;
  Histogram histogram;
  for (const Sample& sample : samples) {
    if (!is_in_lane(sample)) {
      ++histogram.off_lane;
      continue;
    }
    const double relative = sample.lateral_position_m / sample.lane_width_m;
    if (relative < Histogram::edge(0)) {
      ++histogram.underflow;
    } else if (relative >= Histogram::edge(Histogram::bins)) {
      ++histogram.overflow;
    } else {
      // The edges decide, not the rounding of a multiplication.
      std::size_t bin = 0;
      while (relative >= Histogram::edge(bin + 1)) ++bin;
      ++histogram.counts[bin];
    }
  }
  return histogram;
}

}  // namespace septet::logging

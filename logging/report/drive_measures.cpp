#include "logging/report/drive_measures.hpp"

#include <algorithm>
#include <cmath>

namespace septet::logging {
namespace {

constexpr double sample_interval_s = 0.1;

void measure_speed(std::span<const Sample> samples, DriveMeasures& measures) {
  double sum = 0.0;
  for (const Sample& sample : samples) {
    sum += sample.speed_mps;
    measures.speed_largest_mps = std::max(measures.speed_largest_mps, sample.speed_mps);
  }
  const auto count = static_cast<double>(samples.size());
  measures.speed_mean_mps = sum / count;
  double squares = 0.0;
  for (const Sample& sample : samples) squares += std::pow(sample.speed_mps - measures.speed_mean_mps, 2);
  measures.speed_sd_mps = std::sqrt(squares / count);
  for (std::size_t i = 1; i < samples.size(); ++i)
    measures.distance_m += (samples[i].simulated_time_s - samples[i - 1].simulated_time_s) *
                           (samples[i].speed_mps + samples[i - 1].speed_mps) / 2.0;
}

void measure_headway(std::span<const Sample> samples, double longest_s, DriveMeasures& measures) {
  std::vector<double> headways_s;
  for (const Sample& sample : samples) {
    if (!sample.leader || sample.speed_mps <= 1.0) continue;
    const double headway_s = sample.leader->distance_headway_m / sample.speed_mps;
    if (headway_s <= longest_s) headways_s.push_back(headway_s);
  }
  measures.following_s = sample_interval_s * static_cast<double>(headways_s.size());
  if (headways_s.empty()) return;
  std::ranges::sort(headways_s);
  const std::size_t half = headways_s.size() / 2;
  measures.time_headway_smallest_s = headways_s.front();
  measures.time_headway_median_s =
      headways_s.size() % 2 == 1 ? headways_s[half] : (headways_s[half - 1] + headways_s[half]) / 2.0;
}

}  // namespace

DriveMeasures compute_drive_measures(std::span<const Sample> samples, const MeasureSettings& settings) {
  DriveMeasures measures;
  if (samples.empty()) return measures;
  measures.duration_s = samples.back().simulated_time_s - samples.front().simulated_time_s;
  measure_speed(samples, measures);
  measures.lane_changes = find_lane_changes(samples, settings.lane_changes);
  measures.between_lane_changes_s = mean_time_between_lane_changes_s(samples, measures.lane_changes);
  measures.lateral_position =
      compute_lateral_position_statistics(samples, measures.lane_changes, settings.lateral_position);
  measures.histogram = compute_lateral_position_histogram(samples);
  measures.glances = find_glances(samples, settings.glances);
  if (!measures.glances.empty())
    measures.between_glances_s = measures.duration_s / static_cast<double>(measures.glances.size());
  measure_headway(samples, settings.longest_following_headway_s, measures);
  return measures;
}

}  // namespace septet::logging

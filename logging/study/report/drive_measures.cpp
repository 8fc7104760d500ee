#include "logging/study/report/drive_measures.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "logging/study/measures/sample_steps.hpp"

namespace septet::logging {
namespace {

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
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (is_gap(samples[i - 1], samples[i])) continue;
    measures.duration_s += samples[i].simulated_time_s - samples[i - 1].simulated_time_s;
    measures.distance_m += (samples[i].simulated_time_s - samples[i - 1].simulated_time_s) *
                           (samples[i].speed_mps + samples[i - 1].speed_mps) / 2.0;
  }
}

}  // namespace

DriveMeasures compute_drive_measures(const DriveRecords& records, const MeasureSettings& settings) {
  DriveMeasures measures;
  const std::span<const Sample> samples = records.samples;
  measures.samples = samples.size();
  measures.impossible = records.impossible;
  measures.collisions = find_collisions(records.events);
  if (samples.empty()) return measures;
  measure_speed(samples, measures);
  measures.lane_changes = find_lane_changes(samples, settings.lane_changes, put_before_ticks(records.events));
  if (!measures.lane_changes.empty())
    measures.between_lane_changes_s = measures.duration_s / static_cast<double>(measures.lane_changes.size());
  measures.lateral_position =
      compute_lateral_position_statistics(samples, measures.lane_changes, settings.lateral_position);
  measures.histogram = compute_lateral_position_histogram(samples);
  GlanceSettings glances = settings.glances;
  if (!records.glance_areas.empty()) glances.areas = records.glance_areas;
  measures.glance_areas = glances.areas;
  measures.head_is_known = is_head_known(samples);
  if (measures.head_is_known) measures.glances = find_glances(samples, glances);
  if (!measures.glances.empty())
    measures.between_glances_s = measures.duration_s / static_cast<double>(measures.glances.size());
  measures.following = compute_following(samples, settings.following);
  measures.ttc = compute_time_to_collision(samples, settings.ttc);
  TlcSettings tlc = settings.tlc;
  if (records.car_width_m) tlc.half_width_m = *records.car_width_m / 2.0;
  measures.tlc = compute_tlc(samples, measures.lane_changes, tlc);
  auto limits_mps = records.speed_limits_mps;
  limits_mps.resize(samples.size());
  measures.speeding = compute_speeding(samples, limits_mps, settings.speeding);
  measures.accelerations = compute_accelerations(samples, settings.accelerations);
  measures.reversals_visual = compute_reversal_rate(samples, settings.reversals_visual);
  measures.reversals_cognitive = compute_reversal_rate(samples, settings.reversals_cognitive);
  measures.steering_entropy =
      compute_steering_entropy(records.inputs, records.ticks_per_second, settings.steering_entropy);
  measures.hazard_reactions = find_hazard_reactions(records.events, samples, settings.hazard_reaction);
  if (settings.braking_event)
    measures.brake_reactions = find_brake_reactions(records.events, records.inputs, records.ticks_per_second,
                                                    *settings.braking_event, settings.brake_reaction);
  return measures;
}

}  // namespace septet::logging

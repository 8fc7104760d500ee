#include "logging/study/measures/lane_changes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "logging/study/measures/sample_steps.hpp"

namespace septet::logging {
namespace {

/// +1 if the step from `a` to `b` crosses a line to the left, −1 to the right, 0 otherwise. Crossing to the left, the
/// lateral position jumps from the left edge of one lane to the right edge of the next: it falls by a lane width.
int crossed_line(const Sample& a, const Sample& b) {
  if (a.lane == b.lane && a.road == b.road) return 0;
  const double jump_m = b.lateral_position_m - a.lateral_position_m;
  const double lane_width_m = (a.lane_width_m + b.lane_width_m) / 2.0;
  if (std::abs(jump_m) <= lane_width_m / 2.0) return 0;
  return jump_m < 0.0 ? 1 : -1;
}

/// Distance of the reference point beyond the line through which it came into this lane.
double depth_beyond_line_m(const Sample& sample, int came_to_left) {
  return sample.lane_width_m / 2.0 + (came_to_left > 0 ? 1.0 : -1.0) * sample.lateral_position_m;
}

}  // namespace

std::optional<LaneChange> advance(LaneChangeDetector& detector, const Sample& sample) {
  if (sample.lane == 0) {
    detector.previous.reset();
    return std::nullopt;
  }
  if (!detector.previous || is_gap(*detector.previous, sample)) {
    detector.previous = sample;
    detector.counted_lane = sample.lane;
    detector.pending_lanes_to_left = 0;
    return std::nullopt;
  }
  const int crossed = crossed_line(*detector.previous, sample);
  if (crossed != 0) {
    if (detector.pending_lanes_to_left == 0)
      detector.pending = {
          .tick = sample.tick, .simulated_time_s = sample.simulated_time_s, .from_lane = detector.counted_lane};
    detector.pending_lanes_to_left += crossed;
  }
  detector.previous = sample;
  if (detector.pending_lanes_to_left == 0) {
    detector.counted_lane = sample.lane;
    return std::nullopt;
  }
  const bool counts = std::abs(detector.pending_lanes_to_left) > 1 ||
                      depth_beyond_line_m(sample, detector.pending_lanes_to_left) >= detector.settings.hysteresis_m;
  if (!counts) return std::nullopt;
  LaneChange change = detector.pending;
  change.lanes_to_left = detector.pending_lanes_to_left;
  change.to_lane = sample.lane;
  detector.counted_lane = sample.lane;
  detector.pending_lanes_to_left = 0;
  return change;
}

void break_off(LaneChangeDetector& detector) { detector.previous.reset(); }

std::vector<Tick> put_before_ticks(std::span<const Event> events) {
  std::vector<Tick> ticks;
  for (const Event& event : events)
    if (is_put(event)) ticks.push_back(event.tick);
  std::ranges::sort(ticks);
  return ticks;
}

std::vector<LaneChange> find_lane_changes(std::span<const Sample> samples, const LaneChangeSettings& settings,
                                          std::span<const Tick> put_before) {
  LaneChangeDetector detector;
  detector.settings = settings;
  std::vector<LaneChange> changes;
  auto put = put_before.begin();
  for (const Sample& sample : samples) {
    for (; put != put_before.end() && *put <= sample.tick; ++put) break_off(detector);
    if (const auto change = advance(detector, sample)) changes.push_back(*change);
  }
  return changes;
}

}  // namespace septet::logging

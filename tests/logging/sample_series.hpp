#pragma once
// Samples for the tests of the measures: ten a second, lane by lane.

#include <vector>

#include "logging/session/records.hpp"

namespace septet::logging {

inline Sample sample_at(int tenth, std::int32_t lane, double lateral_position_m, double lane_width_m = 3.5) {
  Sample sample;
  sample.tick = static_cast<Tick>(tenth) * 12;
  sample.simulated_time_s = tenth / 10.0;
  sample.lane = lane;
  sample.lateral_position_m = lateral_position_m;
  sample.lane_width_m = lane_width_m;
  return sample;
}

/// The samples of a car that moves through `unrolled_m` (metres to the left of the centre of lane
/// −1), on lanes −1, −2, … to the right (a road with right-hand traffic has its −1 left-most).
inline std::vector<Sample> drive_through(const std::vector<double>& unrolled_m, double lane_width_m = 3.5) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < unrolled_m.size(); ++i) {
    const int lanes_right = static_cast<int>(std::ceil(-unrolled_m[i] / lane_width_m - 0.5));
    samples.push_back(
        sample_at(static_cast<int>(i), -1 - lanes_right, unrolled_m[i] + lanes_right * lane_width_m, lane_width_m));
  }
  return samples;
}

}  // namespace septet::logging

#pragma once
/// Lane changes from samples of lane and lateral position.
///
/// A lane change begins where the car's reference point crosses the line between two lanes. It counts once the point is
/// `hysteresis_m` beyond the line, so that driving on the line is no lane change, and it is dated at the crossing. A
/// line is recognised by the jump of the lateral position from one edge of a lane to the other (more than half a lane
/// width: a car moves less than that from sample to sample); where the lane's number changes without the jump, the road
/// renumbered its lanes and nothing is counted. Samples off every lane (lane 0) break the sequence, and so does a gap
/// of more than a second: a return to the road is not a lane change, nor is an operator's move of the car.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "logging/session/records.hpp"

namespace septet::logging {

struct LaneChangeSettings {
  double hysteresis_m = 0.3;
};

struct LaneChange {
  Tick tick = 0;  ///< Tick of the first sample beyond the line.
  double simulated_time_s = 0.0;
  int lanes_to_left = 0;  ///< +1 one lane to the left, −1 one to the right; ±2 when two lines were crossed.
  std::int32_t from_lane = 0, to_lane = 0;  ///< OpenDRIVE lane ids.
  bool operator==(const LaneChange&) const = default;
};

/// State of the detection between samples.
struct LaneChangeDetector {
  LaneChangeSettings settings;
  std::optional<Sample> previous;
  std::int32_t counted_lane = 0;  ///< The lane the car is in until a change counts.
  int pending_lanes_to_left = 0;  ///< Lines crossed since, not yet counted.
  LaneChange pending;             ///< Dated at the crossing that left the counted lane.
};

/// Takes the next sample; returns the lane change confirmed by this sample.
std::optional<LaneChange> advance(LaneChangeDetector& detector, const Sample& sample);

/// Restarts the detection after the car was put elsewhere: its lanes before and after are unrelated.
void break_off(LaneChangeDetector& detector);

/// Ticks before which an operator put the car elsewhere, ascending, from the log's events.
std::vector<Tick> put_before_ticks(std::span<const Event> events);

/// `put_before`: as returned by put_before_ticks().
std::vector<LaneChange> find_lane_changes(std::span<const Sample> samples, const LaneChangeSettings& settings = {},
                                          std::span<const Tick> put_before = {});

}  // namespace septet::logging

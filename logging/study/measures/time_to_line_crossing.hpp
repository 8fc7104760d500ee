#pragma once
/// Time to line crossing (TLC): time until the car crosses a line of its lane if its motion continues.
///
/// Four definitions, all in use, never to be mixed. With d the distance from the car's side to the line it approaches,
/// ḋ and d̈ its speed and acceleration towards the line:
///
///     simple          d / ḋ
///     quadratic       the first t > 0 with d = ḋt + ½d̈t²
///     van Winsum      d / (ḋ + d̈), d̈ taken for one second: van Winsum, Brookhuis and de Waard, Accid. Anal. Prev. 32 (2000);
///                     close to the trigonometric value, worse than `simple` just before a real crossing
///     trigonometric   the arc of the car's path (a circle of radius speed / yaw rate) to the line (another circle, or straight),
///                     over the speed: van Winsum et al. 1998
///
/// d is measured from the side of the car nearest to the line: `half_width_m` from the reference point of the lateral
/// position (the middle of the front axle). ḋ and d̈ are central differences of the lateral position, so the first and
/// last sample of a run and those at a lane change have none. TLC needs 5 Hz at least (its bandwidth is 2.5 Hz: Lin and
/// Ulsoy 1995); samples come at 10 Hz.

#include <optional>
#include <span>
#include <vector>

#include "logging/session/records.hpp"
#include "logging/study/measures/lane_changes.hpp"

namespace septet::logging {

/// For one line, positive towards it.
struct LineApproach {
  double distance_m = 0.0, speed_mps = 0.0, acceleration_mps2 = 0.0;
};
std::optional<double> simple_tlc_s(const LineApproach& approach);
std::optional<double> quadratic_tlc_s(const LineApproach& approach);
std::optional<double> van_winsum_tlc_s(const LineApproach& approach);

/// The car and one line, seen from the point of the car that will cross it.
struct PathAndLine {
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;  ///< Positive to the left: the path's curvature is this over the speed.
  double heading_rad = 0.0;     ///< Heading of the motion relative to the line's direction abeam, positive to the left.
  double distance_m = 0.0;      ///< To the line, at a right angle to it: positive if it is to the left.
  double line_curvature_pm = 0.0;  ///< Positive if the line bends to the left.
};
/// Exact for every combination of straight and circle. Empty if the path never meets the line.
std::optional<double> trigonometric_tlc_s(const PathAndLine& path);

struct TlcSettings {
  double half_width_m = 0.915;  ///< Default for an unknown car: the Volvo S80 is 1.83 m wide.
  double least_speed_mps = 1.0;
  double short_s = 1.0;  ///< The share of time below this is reported.
  /// Longer ones are no approach to a line: they are excluded from the minima.
  double longest_s = 20.0;
  double exclude_around_lane_change_s = 3.0;
};

enum class TlcKind { simple, quadratic, van_winsum, trigonometric };

/// For one definition, over a drive.
struct TlcStatistics {
  std::optional<double> smallest_s;
  /// Median of the local minima up to `longest_s`, one for each drift towards a line.
  std::optional<double> minimum_median_s;
  std::size_t minima = 0;
  double short_share = 0.0;  ///< Share of the valid samples.
  std::size_t samples = 0;   ///< Samples in their lane, with a derivative, also those without an approach to a line.
  std::size_t not_approaching = 0;  ///< Number of these without an approach.
};

struct TlcMeasures {
  TlcStatistics simple, quadratic, van_winsum, trigonometric;
  double half_width_m = 0.0;  ///< The car's half width used.
  std::size_t over_line = 0;  ///< Samples with a side of the car beyond the line already.
  std::size_t excluded_lane_change = 0;
  std::size_t missing = 0;  ///< Samples off every lane, at a gap of the log, or too slow.
};

TlcMeasures compute_tlc(std::span<const Sample> samples, std::span<const LaneChange> changes,
                        const TlcSettings& settings = {});

}  // namespace septet::logging

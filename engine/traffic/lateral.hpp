#pragma once
/// Sideways motion: a vehicle's place across its lane, and its heading.
///
/// All of it is a function of the distance driven, as of a steered wheel. A change of lane is a quintic, straight at
/// its ends, over a distance of speed times the driver's duration, at walking speed no shorter than the vehicle can
/// steer; making way is a critically damped shift that below `slowest_aside_mps` follows the same path more slowly. The
/// vehicle points along its path, so that its rear axle never slips sideways. The tightest bend has a radius of about
/// 10 m (a car that changes lanes at 6 m/s and brakes as hard as it can), the usual one at walking speed 25 m, and 8 m
/// where one turns out close behind a wreck.

#include <cstdint>

#include "engine/traffic/traffic.hpp"

namespace septet::traffic {

/// Left of the middle of its lane, with the first two derivatives by the distance driven.
struct Lateral {
  double offset_m = 0.0, slope = 0.0, curvature_per_m = 0.0;
};

inline constexpr double slowest_aside_mps = 8.0;
/// Time constant of moving aside: 63 % of the shift in about twice of it.
inline constexpr double aside_time_s = 0.7;

/// How far one steers who changes lanes at walking speed.
enum class Turning : std::uint8_t { at_ease, tight };
/// Length of such a change of a vehicle of this length.
double shortest_change_m(double length_m, Turning turning);
/// Length of the vehicle's last change of lane, from end to end, at this speed.
double change_length_m(const CorridorTraffic& traffic, std::size_t vehicle, double speed_mps);
inline bool changes_lane(const CorridorTraffic& traffic, std::size_t vehicle) {
  return traffic.change_part[vehicle] < 1.0;
}

/// Begins a change of lane from the vehicle's offset and heading, relative to the middle of the target lane.
void begin_change(CorridorTraffic& traffic, std::size_t vehicle, double offset_m, double slope,
                  Turning turning = Turning::at_ease);

Lateral lateral(const CorridorTraffic& traffic, std::size_t vehicle);

/// Over the line of an outermost lane, on to the hard strip.
inline constexpr double on_to_hard_strip_m = 0.4;
/// From the middle of its lane to where a vehicle's side is on the line; 0 for one that is as wide as the lane.
double to_line_m(const CorridorTraffic& traffic, std::size_t vehicle);

/// A vehicle's extent across the road at its heading, as in `LaneEntry`.
struct Across {
  double middle_m = 0.0, half_width_m = 0.0;
};
Across across(const CorridorTraffic& traffic, std::size_t vehicle);
/// Its extent at the end of its change.
Across across_then(const CorridorTraffic& traffic, std::size_t vehicle);

}  // namespace septet::traffic

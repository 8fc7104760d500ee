#pragma once
/// Street lamps of a town, placed so that its lanes are lit as EN 13201 demands of such streets: 7.5 lx in the mean,
/// and everywhere at least 0.35 of the mean (classes P2 and C5).
///
/// Lamps are placed first on each side of a crossing, then in a row along every street, on alternate sides; then all
/// lanes, in junctions too, are searched for dark places, each of which gets the lamp that lights it most among the
/// free positions. No lamp stands within 8 m of another, of any road, on a lane that is driven on,
/// or before a signal. A pole stands at the kerb, on a pavement that is wide enough, else behind it.
///
/// The same network gives the same lamps. World frame, metres.

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/roadside/road_shape.hpp"
#include "engine/roadside/street.hpp"

namespace septet::roadside {

inline constexpr std::size_t most_lamps = 12000;  ///< Limit for a network; further lamps are left out.

/// Lamps of a network whose file places none itself, which street_lamps checks.
std::vector<StreetLamp> planned_lamps(const RoadShape& roads);

/// Illuminance of level ground by lamps, lx. Lamps are indexed by position.
class LampLight {
 public:
  explicit LampLight(const std::vector<StreetLamp>& lamps = {});
  void add(const StreetLamp& lamp);
  /// Illuminance at a place of the ground.
  double lux(const Vec3& ground_m) const;
  /// True if a lamp's pole stands within this distance, less than `reach_m`.
  bool stands_near(const Vec2& p, double distance_m) const;

  /// Reach of a lamp: further away it gives less than a thousandth of its illuminance straight below.
  static constexpr double reach_m = 40.0;

 private:
  struct Placed {
    Vec2 pole_m;
    Vec3 lens_m;
  };
  std::vector<Placed> lamps_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace septet::roadside

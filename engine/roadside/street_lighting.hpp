#pragma once
/// Where street lamps stand so that a town's lanes are lit as EN 13201 asks of such streets: 7.5 lx in the mean, 0.35 of the mean at least (classes P2 and C5).
///
/// First one on each side of a crossing, then a row along every street, on one side and the other by turns, then what is still dark is looked for on all lanes, in
/// junctions too, and gets the lamp that lights it most of those places that are free. No lamp stands within 8 m of another, whichever road either belongs
/// to, on a lane that is driven on, or before a signal. A pole stands at the kerb, on a pavement that is wide enough, else behind it.
///
/// The same network gives the same lamps. World frame, metres.

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/roadside/road_shape.hpp"
#include "engine/roadside/street.hpp"

namespace septet::roadside {

inline constexpr std::size_t most_lamps = 12000;  ///< Of a network; further ones are left away.

/// Of a network whose file places none itself (street_lamps asks).
std::vector<StreetLamp> planned_lamps(const RoadShape& roads);

/// What lamps give level ground at places, lx. Keeps the lamps by where they stand.
class LampLight {
 public:
  explicit LampLight(const std::vector<StreetLamp>& lamps = {});
  void add(const StreetLamp& lamp);
  /// At a place of the ground.
  double lux(const Vec3& ground_m) const;
  /// Whether a lamp's pole stands within this distance, less than `reach_m`.
  bool stands_near(const Vec2& p, double distance_m) const;

  static constexpr double reach_m =
      40.0;  ///< Further away a lamp gives less than a thousandth of what it gives below it.

 private:
  struct Placed {
    Vec2 pole_m;
    Vec3 lens_m;
  };
  std::vector<Placed> lamps_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace septet::roadside

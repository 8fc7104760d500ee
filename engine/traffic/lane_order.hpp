#pragma once
/// Order of vehicles: per lane, all vehicles in it from back to front, the corridor's own and the foreign ones.
///
/// A vehicle that is changing lanes stands in both; one on the line between two lanes as well. The order is kept from
/// tick to tick and repaired by insertion, which costs constant time a vehicle because few overtake within a tick.

#include <cstdint>
#include <vector>

namespace septet::traffic {

struct LaneEntry {
  double x_m = 0.0;  ///< Front bumper.
  double speed_mps = 0.0;
  float length_m = 0.0F;
  float acceleration_mps2 = 0.0F;
  float lateral_m = 0.0F;     ///< The body's middle, as lateral_m of traffic.hpp.
  float half_width_m = 0.0F;  ///< Half the body's extent across the road, at its heading.
  std::int32_t vehicle = -1;  ///< Index in the corridor's arrays; negative for a foreign vehicle.
  bool straddles = false;     ///< Not in the middle of the lane: it is passed where there is room.
};

/// Of `LaneOrder::has_straddlers`, where one of them is a wreck.
inline constexpr std::uint8_t wreck_in_lane = 2;

struct LaneOrder {
  std::vector<std::vector<LaneEntry>> lanes;  ///< [lane number], ascending x.
  std::vector<std::uint8_t> has_straddlers;   ///< [lane number]; above 0: there are some.
};

/// Sorts by x, then by vehicle; quick for an almost sorted lane.
void repair_order(std::vector<LaneEntry>& lane);
void insert_entry(std::vector<LaneEntry>& lane, const LaneEntry& entry);
/// Index of the first entry with x greater than `x_m`, searched from the last result: constant time, for neighbours
/// change slowly. The result is the next hint.
std::size_t first_ahead(const std::vector<LaneEntry>& lane, double x_m, std::size_t hint);

}  // namespace septet::traffic

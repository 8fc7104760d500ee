#pragma once
/// Links of lanes: across lane sections, road links and junctions; direction of travel.

#include <functional>
#include <span>
#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"

namespace septet::road {

/// True where traffic in this lane runs towards increasing s. Right-hand traffic: lanes < 0 do; left-hand: lanes > 0
/// do.
bool runs_along_s(const Road& road, const LaneSection& section, int lane);
bool runs_along_s(const RoadNetwork& network, const LanePosition& position);

/// Continuation of a lane just beyond the end of its section: the lane entered and the end of the section at which it
/// is entered.
struct LaneContinuation {
  RoadIndex road = 0;
  std::uint32_t section = 0;
  int lane = 0;
  bool towards_increasing_s = true;  ///< Direction of s from there on.
};

/// All continuations of `lane` beyond the end (`towards_increasing_s`) or the start of `section`; empty where the lane
/// ends.
std::vector<LaneContinuation> continuations(const RoadNetwork& network, RoadIndex road, std::uint32_t section, int lane,
                                            bool towards_increasing_s);

/// Chooses among two or more continuations; returns an index.
using ChooseContinuation = std::function<std::size_t(std::span<const LaneContinuation>)>;

struct Advanced {
  LanePosition position;
  bool towards_increasing_s = true;  ///< Direction of s at the new position, in the direction of the advance.
  double remaining_m = 0.0;          ///< Rest of the distance where the lane ended; 0 otherwise.
};

/// Advances `distance_m` along the lane, in its direction of travel if positive, backwards if negative, measured along
/// the reference lines (divide by RoadPoint::stretch for metres in the lane). The lane's offset is kept, mirrored where
/// the next road runs the other way. Without `choose` the first continuation is taken.
Advanced advance(const RoadNetwork& network, const LanePosition& from, double distance_m,
                 const ChooseContinuation& choose = {});

}  // namespace septet::road

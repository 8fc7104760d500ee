#include <algorithm>
#include <cmath>

#include "engine/traffic/traffic_stages.hpp"

namespace septet::traffic {
namespace {

constexpr double side_clearance_m = 0.3;
/// Beside wrecks, at walking speed.
constexpr double slow_clearance_m = 0.15, slow_mps = 3.0;
constexpr int most_passed = 40;
constexpr double longest_m = 20.0;  ///< Of all vehicles.
/// Excess speed of an emergency vehicle over those it passes, and its look-ahead at them.
constexpr double passing_excess_mps = 11.0;
constexpr double passing_look_ahead_m = 40.0;

bool apart(const Across& a, const Across& b, double clearance_m) {
  return std::abs(a.middle_m - b.middle_m) > a.half_width_m + b.half_width_m + clearance_m;
}

/// Room now and at the targets of both: a vehicle that moves in front of another is in its path at once.
bool has_room_beside(const CorridorTraffic& traffic, const LaneEntry& own, const LaneEntry& other, double clearance_m) {
  const auto now = [](const LaneEntry& e) { return Across{e.lateral_m, e.half_width_m}; };
  const auto then = [&](const LaneEntry& e) {
    return e.vehicle >= 0 ? across_then(traffic, static_cast<std::size_t>(e.vehicle)) : now(e);
  };
  return apart(now(own), now(other), clearance_m) && apart(then(own), now(other), clearance_m) &&
         apart(now(own), then(other), clearance_m);
}

/// The next obstructing vehicle ahead, in a lane where some are not in its middle. Vehicles that an emergency vehicle
/// passes bound its speed. Beside wrecks everybody is passed as soon as there is room, and so the one whose front is
/// next may stand beside another's long body: the leader is the one whose rear is nearest.
const LaneEntry* leader_among_straddlers(const CorridorTraffic& traffic, int lane_number, std::size_t k,
                                         double& speed_limit_mps) {
  const std::vector<LaneEntry>& lane = traffic.order.lanes[static_cast<std::size_t>(lane_number)];
  const LaneEntry& own = lane[k];
  const bool emergency = traffic.emergency[static_cast<std::size_t>(own.vehicle)] != 0;
  const bool beside_wreck = traffic.order.has_straddlers[static_cast<std::size_t>(lane_number)] == wreck_in_lane;
  const double clearance_m = beside_wreck && own.speed_mps < slow_mps ? slow_clearance_m : side_clearance_m;
  const LaneEntry* leader = nullptr;
  double leader_m = no_leader;
  const std::size_t count = lane.size();
  for (std::size_t step = 1; step < count && step <= most_passed; ++step) {
    std::size_t at = k + step;
    if (at >= count) {
      if (!traffic.corridor.closed) break;
      at -= count;
    }
    const LaneEntry& other = lane[at];
    if (other.vehicle == own.vehicle) continue;
    const double ahead = gap_to(traffic, lane_number, own.x_m, &other);
    if (leader != nullptr && ahead + other.length_m > leader_m + longest_m) break;
    const bool passable =
        (emergency || beside_wreck || other.straddles) && has_room_beside(traffic, own, other, clearance_m);
    if (!passable) {
      if (ahead < leader_m) leader = &other, leader_m = ahead;
      if (!beside_wreck) break;
      continue;
    }
    if (emergency && ahead < passing_look_ahead_m) {
      speed_limit_mps = std::min(speed_limit_mps, other.speed_mps + passing_excess_mps);
    }
  }
  return leader;
}

/// Follows with a test of every straddling vehicle, where some are not in the middle of a lane.
void follow_carefully(CorridorTraffic& traffic, int lane_number) {
  const std::vector<LaneEntry>& lane = traffic.order.lanes[static_cast<std::size_t>(lane_number)];
  for (std::size_t k = 0; k < lane.size(); ++k) {
    const LaneEntry& own = lane[k];
    if (own.vehicle < 0) continue;
    const auto i = static_cast<std::size_t>(own.vehicle);
    double limit = no_leader;
    const LaneEntry* leader = leader_among_straddlers(traffic, lane_number, k, limit);
    double a =
        acceleration_behind(traffic.law[i], own.speed_mps, leader, gap_to(traffic, lane_number, own.x_m, leader));
    if (own.speed_mps > limit - 1.0) {
      a = std::min(a, std::clamp(limit - own.speed_mps, -3.0, 1.0));
    }
    traffic.acceleration_mps2[i] = std::min(traffic.acceleration_mps2[i], a);
  }
}

void follow_in_lane(CorridorTraffic& traffic, int lane_number) {
  const std::vector<LaneEntry>& lane = traffic.order.lanes[static_cast<std::size_t>(lane_number)];
  const LaneWay& way = traffic.ways.lanes[static_cast<std::size_t>(lane_number)];
  const std::size_t count = lane.size();
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const LaneEntry& own = lane[k];
    if (own.vehicle < 0) continue;
    const auto i = static_cast<std::size_t>(own.vehicle);
    const LaneEntry& leader = lane[k + 1];
    const double gap = (way.way_m.empty() ? (leader.x_m - own.x_m) * way.stretch
                                          : way_at_m(way, leader.x_m) - way_at_m(way, own.x_m)) -
                       leader.length_m;
    const double a = acceleration_behind(traffic.law[i], own.speed_mps, &leader, gap);
    traffic.acceleration_mps2[i] = std::min(traffic.acceleration_mps2[i], a);
  }
  if (count == 0 || lane.back().vehicle < 0) return;
  const LaneEntry& own = lane.back();
  const auto i = static_cast<std::size_t>(own.vehicle);
  const LaneEntry* leader = traffic.corridor.closed && count > 1 ? &lane.front() : nullptr;
  const double a =
      acceleration_behind(traffic.law[i], own.speed_mps, leader, gap_to(traffic, lane_number, own.x_m, leader));
  traffic.acceleration_mps2[i] = std::min(traffic.acceleration_mps2[i], a);
}

}  // namespace

LaneEntry entry_of(const CorridorTraffic& traffic, std::size_t i) {
  const Across body = across(traffic, i);
  return {traffic.x_m[i],
          traffic.speed_mps[i],
          static_cast<float>(traffic.length_m[i]),
          static_cast<float>(traffic.acceleration_mps2[i]),
          static_cast<float>(body.middle_m),
          static_cast<float>(body.half_width_m),
          static_cast<std::int32_t>(i),
          traffic.emergency[i] != 0};
}

void refresh_order(CorridorTraffic& traffic, const ForeignTraffic& foreign) {
  const bool careful = traffic.any_aside || !foreign.entries.empty();
  auto& lanes = traffic.order.lanes;
  for (std::size_t l = 0; l < lanes.size(); ++l) {
    auto& lane = lanes[l];
    bool straddlers = false;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < lane.size(); ++k) {
      if (lane[k].vehicle < 0) continue;
      const auto i = static_cast<std::size_t>(lane[k].vehicle);
      const bool emergency = traffic.emergency[i] != 0;
      if (traffic.lane[i] != static_cast<int>(l) && traffic.from_lane[i] != static_cast<int>(l)) continue;
      if (kept != k) lane[kept] = lane[k];
      LaneEntry& entry = lane[kept++];
      entry.x_m = traffic.x_m[i];
      entry.speed_mps = traffic.speed_mps[i];
      entry.acceleration_mps2 = static_cast<float>(traffic.acceleration_mps2[i]);
      if (careful) {
        const Across body = across(traffic, i);
        entry.lateral_m = static_cast<float>(body.middle_m);
        entry.half_width_m = static_cast<float>(body.half_width_m);
      }
      straddlers = straddlers || emergency;
    }
    lane.resize(kept);
    repair_order(lane);
    traffic.order.has_straddlers[l] = straddlers ? 1 : 0;
  }
  for (const auto& [lane, entry] : foreign.entries) {
    if (lane < 1 || lane >= static_cast<int>(lanes.size())) continue;
    insert_entry(lanes[static_cast<std::size_t>(lane)], entry);
    if (entry.straddles) traffic.order.has_straddlers[static_cast<std::size_t>(lane)] = 1;
  }
}

Neighbours neighbours(const CorridorTraffic& traffic, int lane_number, double x_m, std::int32_t self,
                      std::uint32_t& hint) {
  const std::vector<LaneEntry>& lane = traffic.order.lanes[static_cast<std::size_t>(lane_number)];
  const std::size_t count = lane.size();
  const std::size_t from = first_ahead(lane, x_m, hint);
  hint = static_cast<std::uint32_t>(from);
  const bool closed = traffic.corridor.closed;
  Neighbours result;
  // The vehicle itself is at most once in a lane, so that at most one step skips it.
  std::size_t at = from;
  for (int tries = 0; tries < 2 && result.ahead == nullptr; ++tries, ++at) {
    if (at >= count) {
      if (!closed || count == 0) break;
      at = 0;
    }
    if (self < 0 || lane[at].vehicle != self) result.ahead = &lane[at];
  }
  at = from;
  for (int tries = 0; tries < 2 && result.behind == nullptr; ++tries) {
    if (at == 0) {
      if (!closed || count == 0) break;
      at = count;
    }
    --at;
    if (self < 0 || lane[at].vehicle != self) result.behind = &lane[at];
  }
  return result;
}

void follow(CorridorTraffic& traffic) {
  std::fill(traffic.acceleration_mps2.begin(), traffic.acceleration_mps2.end(), no_leader);
  for (std::size_t l = 0; l < traffic.order.lanes.size(); ++l) {
    if (traffic.order.has_straddlers[l] != 0)
      follow_carefully(traffic, static_cast<int>(l));
    else
      follow_in_lane(traffic, static_cast<int>(l));
  }
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    if (traffic.lane[i] == 0) {
      traffic.acceleration_mps2[i] = 0.0;
      continue;
    }
    traffic.acceleration_mps2[i] = within_bounds(traffic, traffic.lane[i], traffic.x_m[i], traffic.speed_mps[i],
                                                 traffic.emergency[i] != 0, traffic.acceleration_mps2[i]);
    const double to_end = to_lane_end_m(traffic, traffic.lane[i], traffic.x_m[i], traffic.lane_end_m[i]);
    if (to_end > look_ahead_lane_end_m) continue;
    // A lane that ends is a standing obstacle.
    constexpr LaneEntry end{};
    const double a = acceleration_behind(traffic.law[i], traffic.speed_mps[i], &end, to_end);
    traffic.acceleration_mps2[i] = std::min(traffic.acceleration_mps2[i], a);
  }
}

}  // namespace septet::traffic

#include "engine/road/turn.hpp"

#include <cmath>
#include <cstdint>

#include "engine/road/lane_links.hpp"
#include "engine/road/road_position.hpp"

namespace septet::road {
namespace {

constexpr double least_turn_rad = 0.5;

}  // namespace

int turn_through(const RoadNetwork& network, RoadIndex connecting, int lane, bool along_s) {
  const Road& road = network.roads[connecting];
  const RoadLink& before = along_s ? road.predecessor : road.successor;
  if (road.junction == no_index || before.road == no_index) return 0;
  const Road& incoming = network.roads[before.road];
  const bool leaves_at_end = before.contact == ContactPoint::end;
  // The lane of entry, and its other continuations.
  const LaneSection& entered = along_s ? road.sections.front() : road.sections.back();
  if (!entered.has_lane(lane)) return 0;
  const auto& from = along_s ? entered.lane(lane).predecessors : entered.lane(lane).successors;
  const auto last = static_cast<std::uint32_t>(leaves_at_end ? incoming.sections.size() - 1 : 0);
  if (from.empty() || continuations(network, before.road, last, from.front(), leaves_at_end).size() < 2) return 0;

  const auto heading = [&](bool at_end) {
    return evaluate(network, {connecting, at_end ? road.length_m : 0.0, 0.0}).heading_rad;
  };
  const double turned_rad = along_s ? heading(true) - heading(false) : heading(false) - heading(true);
  const double curvature =
      evaluate(network, {before.road, leaves_at_end ? incoming.length_m : 0.0, 0.0}).curvature_per_m;
  const double kept_rad = (leaves_at_end ? curvature : -curvature) * road.length_m;
  const double turn_rad = wrap_angle(turned_rad) - kept_rad;
  return turn_rad > least_turn_rad ? 1 : turn_rad < -least_turn_rad ? -1 : 0;
}

}  // namespace septet::road

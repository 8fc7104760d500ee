#include "engine/traffic/corridor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/core/check.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"

namespace septet::traffic {
namespace {

struct Step {
  road::RoadIndex road;
  int lane;
  bool along_s;
  bool operator==(const Step&) const = default;
};

/// Number of the lane at the far end of the road, followed section by section; 0 where the lane ends before.
int lane_at_far_end(const road::RoadNetwork& network, Step step) {
  const road::Road& road = network.roads[step.road];
  const auto count = static_cast<int>(road.sections.size());
  int lane = step.lane;
  for (int i = step.along_s ? 0 : count - 1; i >= 0 && i < count; i += step.along_s ? 1 : -1) {
    if (!road.sections[static_cast<std::size_t>(i)].has_lane(lane)) return 0;
    const bool last = step.along_s ? i == count - 1 : i == 0;
    if (last) return lane;
    for (const auto& next : road::continuations(network, step.road, static_cast<std::uint32_t>(i), lane, step.along_s))
      if (next.road == step.road) lane = next.lane;
  }
  return lane;
}

/// The road after this one, where the lane continues; the one that keeps most lanes where there is a choice.
std::optional<Step> next_road(const road::RoadNetwork& network, Step step) {
  const road::Road& road = network.roads[step.road];
  const int lane = lane_at_far_end(network, step);
  if (lane == 0) return std::nullopt;
  const auto section = static_cast<std::uint32_t>(step.along_s ? road.sections.size() - 1 : 0);
  std::optional<Step> best;
  int best_lanes = -1;
  for (const auto& next : road::continuations(network, step.road, section, lane, step.along_s)) {
    const auto& entered = network.roads[next.road].sections[next.section];
    const int lanes = next.lane > 0 ? entered.left_count : entered.right_count;
    if (lanes > best_lanes) {
      best = Step{next.road, next.lane, next.towards_increasing_s};
      best_lanes = lanes;
    }
  }
  return best;
}

/// Station on a piece, metres from its begin.
double station_on(const CorridorPiece& piece, double along_m) {
  const double s_m = piece.along_s ? along_m : piece.length_m - along_m;
  if (piece.inset_m == 0.0) return s_m;
  return piece.from_s_m + std::clamp(s_m, piece.inset_m, std::max(piece.inset_m, piece.length_m - piece.inset_m));
}

Step reversed(Step step) { return {step.road, step.lane, !step.along_s}; }

}  // namespace

Corridor build_corridor(const road::RoadNetwork& network, const road::LanePosition& through) {
  const bool along = road::runs_along_s(network, through);
  const Step start{through.road, through.lane, along};
  // Back to its beginning (a ring comes back to the start), then forward from there.
  Step first = start;
  bool closed = false;
  for (std::size_t i = 0; i < network.roads.size(); ++i) {
    const auto before = next_road(network, reversed(first));
    if (!before) break;
    first = reversed(*before);
    if (first.road == start.road) {
      closed = true;
      break;
    }
  }
  Corridor corridor;
  corridor.closed = closed;
  std::optional<Step> step = first;
  for (std::size_t i = 0; step && i <= network.roads.size(); ++i) {
    const bool again =
        std::ranges::any_of(corridor.pieces, [&](const CorridorPiece& piece) { return piece.road == step->road; });
    if (again) break;
    const double length = network.roads[step->road].length_m;
    corridor.pieces.push_back({step->road, step->along_s, step->lane > 0 ? 1 : -1, corridor.length_m, length});
    corridor.length_m += length;
    step = next_road(network, *step);
  }
  return corridor;
}

std::optional<road::LanePosition> opposite_lane(const road::RoadNetwork& network, const road::LanePosition& position) {
  const auto& section = road::section_at(network.roads[position.road], position.s_m);
  const int sign = position.lane > 0 ? -1 : 1;
  for (int lane = sign; section.has_lane(lane); lane += sign)
    if (road::is_drivable(section.lane(lane).type)) return road::LanePosition{position.road, lane, position.s_m, 0.0};
  return std::nullopt;
}

const CorridorPiece* piece_of(const Corridor& corridor, const road::RoadPosition& position) {
  const CorridorPiece* best = nullptr;
  double least_m = 0.0;
  for (const CorridorPiece& piece : corridor.pieces) {
    if (piece.road != position.road) continue;
    const double past_m =
        std::max({0.0, piece.from_s_m - position.s_m, position.s_m - piece.from_s_m - piece.length_m});
    if (best && past_m >= least_m) continue;
    best = &piece;
    least_m = past_m;
  }
  return best;
}

const CorridorPiece& piece_at(const Corridor& corridor, double x_m) {
  SEPTET_CHECK(!corridor.pieces.empty(), "a corridor without roads at {}", x_m);
  const auto after = std::ranges::upper_bound(corridor.pieces, x_m, {}, &CorridorPiece::x_m);
  return after == corridor.pieces.begin() ? corridor.pieces.front() : *std::prev(after);
}

double length_along_lane_m(const road::RoadNetwork& network, const Corridor& corridor, int lane, double x_m,
                           double ahead_m, double step_m) {
  const double sign = ahead_m < 0.0 ? -1.0 : 1.0, nudge_m = 1e-6;
  double left = std::abs(ahead_m), x = wrap_x(corridor, x_m), sum = 0.0;
  // Piece by piece; beyond an open corridor's end as on the line.
  const double begin_m = corridor.pieces.empty() ? 0.0 : corridor.pieces.front().x_m;
  while (left > 0.0 && (corridor.closed || (sign > 0.0 ? x < corridor.length_m : x > begin_m))) {
    const CorridorPiece& piece = piece_at(corridor, sign > 0.0 ? x : x - nudge_m);
    const double begin = std::clamp(x - piece.x_m, 0.0, piece.length_m);
    const double to_end = sign > 0.0 ? piece.length_m - begin : begin;
    const double part = std::min(left, to_end);
    const auto s = [&](double along) { return station_on(piece, along); };
    sum += std::abs(road::length_along_lane_m(
        network, {piece.road, piece.side * (lane - piece.lane_shift), s(begin), 0.0}, s(begin + sign * part), step_m));
    left -= part;
    x = wrap_x(corridor, x + sign * std::max(part, nudge_m));
    if (sign < 0.0 && corridor.closed && x <= 0.0) x += corridor.length_m;
  }
  return sign * (sum + left);
}

road::LanePosition position_at(const Corridor& corridor, double x_m, int lane) {
  const CorridorPiece& piece = piece_at(corridor, x_m);
  const double along = std::clamp(x_m - piece.x_m, 0.0, piece.length_m);
  return {piece.road, piece.side * (lane - piece.lane_shift), station_on(piece, along), 0.0};
}

bool lane_open(const road::RoadNetwork& network, const Corridor& corridor, double x_m, int lane) {
  if (lane - piece_at(corridor, x_m).lane_shift < 1) return false;
  const auto position = position_at(corridor, x_m, lane);
  const auto& section = road::section_at(network.roads[position.road], position.s_m);
  return section.has_lane(position.lane) && road::is_drivable(section.lane(position.lane).type);
}

std::optional<double> x_of(const road::RoadNetwork&, const Corridor& corridor, const road::RoadPosition& position,
                           int lane) {
  const CorridorPiece* piece = piece_of(corridor, position);
  return piece && lane * piece->side > 0 ? std::optional(x_on_piece(*piece, position.s_m)) : std::nullopt;
}

}  // namespace septet::traffic

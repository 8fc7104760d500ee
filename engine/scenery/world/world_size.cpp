#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "engine/road/road_limits.hpp"
#include "engine/scene/world_bounds.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "engine/scenery/world/world_context.hpp"

namespace septet::scenery {
namespace {

// Limits. For comparison, the motorway's 11 km take 110 squares, 173 km of lanes, 4,500 dashes and 10 MB on the wire.
constexpr std::size_t most_squares = 1500, most_structures = 2000, most_signals = 20'000;
constexpr double most_lane_m = 2e7, most_dashes = 5e5;

// A road's points lie up to twice as far as its beginning may (engine/road/read_plan.cpp), and what stands beside it little further.
static_assert(scene::farthest_m >= 2.0 * road::farthest_m + 1e6);

tl::unexpected<Error> too_large(std::string what) {
  return failure(std::move(what), "the road network", "cut out of it the part that is driven");
}

/// Squares of land, counted until there are too many.
std::size_t count_squares(const RoadShape& roads) {
  constexpr double step_m = 1000.0;
  std::set<std::pair<std::int64_t, std::int64_t>> squares;
  for (road::RoadIndex index = 0; index < roads.network().roads.size(); ++index) {
    const double begin = roads.begin_m(index), end = roads.end_m(index);
    for (double s = begin; s < end + step_m && squares.size() <= most_squares; s += step_m) {
      const Vec2 place(roads.at(index, std::min(s, end), 0.0).position_m);
      for (const glm::i64vec2& square : squares_near({place}, land_tile_m, land_reach_m))
        squares.emplace(square.x, square.y);
    }
  }
  return squares.size();
}

double dashes_of(const road::RoadMark& mark, double section_m) {
  double dashes = 0.0;
  const double length = std::min(mark.s_end_m - mark.s_m, section_m);
  for (const road::RoadMarkLine& line : mark.lines)
    if (line.space_m > 0.0) dashes += length / (line.length_m + line.space_m);
  return dashes;
}

}  // namespace

Expected<void> check_world_size(const road::RoadNetwork& network, const RoadWorldOptions& options) {
  std::size_t structures = 0, signals = 0;
  double lane_m = 0.0, dashes = 0.0;
  for (const road::Road& road : network.roads) {
    structures += road.structures.size();
    signals += road.signals.size();
    for (const road::LaneSection& section : road.sections) {
      const double length = section.s_end_m - section.s_m;
      lane_m += length * static_cast<double>(section.lanes.size());
      for (const road::Lane& lane : section.lanes)
        for (const road::RoadMark& mark : lane.marks) dashes += dashes_of(mark, length);
    }
  }
  if (lane_m > most_lane_m)
    return too_large(fmt::format("its lanes are {:.0f} km long, more than {:.0f} km", lane_m / 1e3, most_lane_m / 1e3));
  if (dashes > most_dashes)
    return too_large(fmt::format("its lines have {:.0f} dashes, more than {:.0f}", dashes, most_dashes));
  if (structures > most_structures)
    return too_large(fmt::format("it has {} bridges and tunnels, more than {}", structures, most_structures));
  if (signals > most_signals) return too_large(fmt::format("it has {} signals, more than {}", signals, most_signals));
  if (count_squares(RoadShape(network, options.overrun_m)) > most_squares)
    return too_large(fmt::format("the land around it is larger than {:.0f} km²",
                                 static_cast<double>(most_squares) * land_tile_m * land_tile_m / 1e6));
  return {};
}

}  // namespace septet::scenery

#pragma once
/// The road from above, as lines to draw: made once a drive.

#include <vector>

#include "engine/road/road_network.hpp"

namespace septet::page {

struct RoadMap {
  enum class Kind : std::uint8_t { carriageway, edge, line };
  struct Shape {
    Kind kind = Kind::edge;      ///< Outline of a carriageway, else a line.
    std::vector<Vec2> points_m;  ///< World frame.
  };
  std::vector<Shape> shapes;  ///< Carriageways first.
};

/// Accurate to `tolerance_m`. `most_points` bounds the data for a browser: a network that needs more becomes coarser.
RoadMap road_map(const road::RoadNetwork& network, double tolerance_m = 0.15, std::size_t most_points = 60000);

/// Removes the points that lie within `tolerance_m` of the line through the others (Ramer, Douglas and Peucker).
std::vector<Vec2> simplified(const std::vector<Vec2>& points_m, double tolerance_m);

}  // namespace septet::page

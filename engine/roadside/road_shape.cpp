#include "engine/roadside/road_shape.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"

namespace septet::roadside {

RoadShape::RoadShape(const road::RoadNetwork& network, double overrun_m) : network_(network) {
  const auto is_loose = [](const road::RoadLink& link) {
    return link.road == road::no_index && link.junction == road::no_index;
  };
  for (road::RoadIndex index = 0; index < network.roads.size(); ++index) {
    const road::Road& loose = network.roads[index];
    begins_m_.push_back(is_loose(loose.predecessor) ? -free_overrun_m(index, false, overrun_m) : 0.0);
    ends_m_.push_back(loose.length_m + (is_loose(loose.successor) ? free_overrun_m(index, true, overrun_m) : 0.0));
  }
}

double RoadShape::free_overrun_m(road::RoadIndex index, bool at_end, double most_m) const {
  constexpr double look_m = 4.0, verge_m = 6.0;
  const road::Road& loose = network_.roads[index];
  const double end_m = at_end ? loose.length_m : 0.0;
  const road::RoadExtent extent = road::road_extent(loose, end_m);
  const auto meets = [&](double beyond_m) {
    for (const double t : {extent.right_t_m, 0.5 * (extent.right_t_m + extent.left_t_m), extent.left_t_m})
      for (const road::Location& other :
           road::roads_holding(network_, Vec2(at(index, at_end ? end_m + beyond_m : -beyond_m, t).position_m)))
        if (other.position.road != index || std::abs(other.position.s_m - end_m) > look_m) return true;
    return false;
  };
  // A loose end that lies on another road's lanes has no overrun at all.
  for (double beyond_m = 0.5; beyond_m < most_m; beyond_m += look_m)
    if (meets(beyond_m)) return std::max(0.0, beyond_m - look_m - verge_m);
  return most_m;
}

double RoadShape::begin_m(road::RoadIndex index) const { return begins_m_[index]; }

double RoadShape::end_m(road::RoadIndex index) const { return ends_m_[index]; }

road::RoadPoint RoadShape::at(road::RoadIndex index, double s_m, double t_m) const {
  const double length = road(index).length_m;
  const double inside = std::clamp(s_m, 0.0, length);
  road::RoadPoint point = road::evaluate(network_, {index, inside, t_m});
  if (const double beyond = s_m - inside; beyond != 0.0) {
    point.position_m.x += std::cos(point.heading_rad) * beyond;
    point.position_m.y += std::sin(point.heading_rad) * beyond;
    // Fade of the grade within the first few hundred metres.
    constexpr double run_out_m = 250.0;
    point.position_m.z -= std::tan(point.pitch_rad) * run_out_m * std::tanh(beyond / run_out_m);
  }
  return point;
}

Vec3 RoadShape::point(road::RoadIndex index, double s_m, double t_m, double up_m) const {
  const road::RoadPoint p = at(index, s_m, t_m);
  return road::world_from_road(p) * Vec3(0, 0, up_m);
}

glm::vec3 RoadShape::local(const RoadTile& tile, double s_m, double t_m, double up_m) const {
  return local(tile, point(tile.road, s_m, t_m, up_m));
}

glm::vec3 RoadShape::local(const RoadTile& tile, const Vec3& world_m) const {
  return glm::vec3(inverse(tile.world_from_tile) * world_m);
}

const road::RoadStructure* RoadShape::structure_at(road::RoadIndex index, double s_m,
                                                   road::RoadStructure::Kind kind) const {
  return road::structure_at(road(index), s_m, kind);
}

std::vector<RoadTile> RoadShape::tiles(double length_m) const {
  using Kind = road::RoadStructure::Kind;
  std::vector<RoadTile> result;
  for (road::RoadIndex index = 0; index < network_.roads.size(); ++index) {
    std::vector<double> cuts{begin_m(index), 0.0, road(index).length_m, end_m(index)};
    for (const road::LaneSection& section : road(index).sections) cuts.push_back(section.s_m);
    for (const road::RoadStructure& structure : road(index).structures)
      cuts.insert(cuts.end(), {structure.s_m, structure.s_m + structure.length_m});
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double length = cuts[i + 1] - cuts[i];
      if (length < 0.01) continue;
      const double count = std::ceil(length / length_m - 1e-9);
      for (int k = 0; k < static_cast<int>(count); ++k) {
        RoadTile tile;
        tile.road = index;
        tile.s0_m = cuts[i] + length * k / count;
        tile.s1_m = cuts[i] + length * (k + 1) / count;
        const road::RoadPoint middle = at(index, tile.middle_m(), 0.0);
        tile.world_from_tile = {middle.position_m, orientation_from_angles(middle.heading_rad, 0.0, 0.0)};
        tile.in_tunnel = structure_at(index, tile.middle_m(), Kind::tunnel) != nullptr;
        tile.on_bridge = structure_at(index, tile.middle_m(), Kind::bridge) != nullptr;
        result.push_back(tile);
      }
    }
  }
  return result;
}

std::vector<double> height_steps(const RoadShape& roads, const RoadTile& tile) {
  std::vector<double> steps;
  for (const road::Lane& lane : road::section_at(roads.road(tile.road), tile.middle_m()).lanes)
    for (const road::LaneHeight& height : lane.heights)
      if (height.s_m > tile.s0_m + 0.01 && height.s_m < tile.s1_m - 0.01) steps.push_back(height.s_m);
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

std::vector<double> close_stations(const RoadShape& roads, const RoadTile& tile, double most_step_m) {
  constexpr double most_aside_m = 0.03, most_over_m = 0.01, inside_m = 1e-6;
  const double least_step_m = std::max(0.6, (tile.s1_m - tile.s0_m) / 128.0);
  const auto edge = [&](double s_m, int side) {
    const road::RoadExtent extent = road::road_extent(roads.road(tile.road), s_m);
    return roads.point(tile.road, s_m, side == 0 ? 0.0 : side > 0 ? extent.left_t_m : extent.right_t_m);
  };
  const auto leaves = [&](double s0_m, double s1_m, int side) {
    const Vec3 from = edge(s0_m + inside_m, side), to = edge(s1_m - inside_m, side),
               off = edge(0.5 * (s0_m + s1_m), side) - 0.5 * (from + to);
    const Vec2 chord(to - from);
    const double length = glm::length(chord);
    // Only the distance across the chord is an error: stations are not evenly spaced along an edge.
    const double aside = length > 0.0 ? std::abs(chord.x * off.y - chord.y * off.x) / length : glm::length(Vec2(off));
    return aside > most_aside_m || std::abs(off.z) > most_over_m;
  };
  std::vector<double> cuts = height_steps(roads, tile), result{tile.s0_m};
  cuts.push_back(tile.s1_m);
  RoadTile piece = tile;
  for (const double cut : cuts) {
    piece.s1_m = cut;
    double step = most_step_m;
    std::vector<double> along = stations(piece, step);
    const auto any_leaves = [&] {
      for (std::size_t i = 0; i + 1 < along.size(); ++i)
        for (const int side : {-1, 0, 1})
          if (leaves(along[i], along[i + 1], side)) return true;
      return false;
    };
    while (step > least_step_m && any_leaves()) along = stations(piece, step *= 0.5);
    result.insert(result.end(), along.begin() + 1, along.end());
    piece.s0_m = cut;
  }
  return result;
}

std::vector<double> stations(const RoadTile& tile, double step_m) {
  const double length = tile.s1_m - tile.s0_m;
  const int count = std::max(1, static_cast<int>(std::ceil(length / step_m - 1e-9)));
  std::vector<double> result;
  for (int i = 0; i <= count; ++i) result.push_back(tile.s0_m + length * i / count);
  return result;
}

}  // namespace septet::roadside

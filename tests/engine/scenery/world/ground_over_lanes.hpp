#pragma once
/// Drawn ground over lanes, for tests.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_position.hpp"
#include "engine/roadside/lane_levels.hpp"
#include "tests/engine/scenery/world/drawn_world.hpp"

namespace septet::scenery {

/// Place on a lane that is driven or walked.
struct LanePlace {
  road::RoadPosition position;
  Vec3 surface_m;
};

/// Places every 2 m of every lane: its middle and 0.25 m inside of both edges. Tunnels, over which land lies, are left
/// out.
inline std::vector<LanePlace> lane_places(const road::RoadNetwork& network) {
  constexpr double step_m = 2.0, inside_m = 0.25;
  std::vector<LanePlace> places;
  for (road::RoadIndex index = 0; index < network.roads.size(); ++index) {
    const road::Road& road = network.roads[index];
    for (double s = std::min(0.5, 0.5 * road.length_m); s < road.length_m; s += step_m) {
      if (std::ranges::any_of(road.structures, [&](const road::RoadStructure& structure) {
            return structure.kind == road::RoadStructure::Kind::tunnel && s > structure.s_m - 30.0 &&
                   s < structure.s_m + structure.length_m + 30.0;
          }))
        continue;
      const road::LaneSection& section = road::section_at(road, s);
      for (int lane = -section.right_count; lane <= section.left_count; ++lane) {
        if (lane == 0) continue;
        const road::LaneType type = section.lane(lane).type;
        if (!road::is_drivable(type) && !roadside::is_walked(type)) continue;
        const road::LaneBorders borders = road::lane_borders(road, section, lane, s);
        if (borders.width_m() < 4 * inside_m) continue;
        const double low = std::min(borders.inner_t_m, borders.outer_t_m), high = low + borders.width_m();
        for (const double t : {low + inside_m, 0.5 * (low + high), high - inside_m}) {
          const road::RoadPosition position{index, s, t};
          places.push_back({position, road::evaluate(network, position).position_m});
        }
      }
    }
  }
  return places;
}

/// Number of places with drawn ground over them, and the worst one in words.
struct Buried {
  std::size_t places = 0, buried = 0;
  double most_m = 0.0;
  std::string worst;
  std::unordered_map<std::string, std::size_t> by_mesh;
};

inline Buried buried_lanes(const road::RoadNetwork& network, const scene::Store& store) {
  constexpr double noticed_m = 0.02;
  constexpr PlaneCells cells{4.0};
  const std::vector<LanePlace> places = lane_places(network);
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> by_cell;
  for (std::uint32_t i = 0; i < places.size(); ++i) by_cell[cells.key_at(Vec2(places[i].surface_m))].push_back(i);
  std::vector<bool> is_buried(places.size());
  Buried result{places.size()};
  for (const std::string_view mesh : {"land", "verge", "pavement"})
    for (const DrawnTriangle& triangle : drawn_triangles(store, mesh)) {
      if (mesh == "pavement" && triangle.material != "world/verge" && triangle.material != "world/gravel") continue;
      const auto& [a, b, c] = triangle.corners_m;
      const Vec2 u = Vec2(b) - Vec2(a), v = Vec2(c) - Vec2(a);
      const double area = u.x * v.y - u.y * v.x;
      if (std::abs(area) < 1e-6) continue;
      const Vec2 low = glm::min(glm::min(Vec2(a), Vec2(b)), Vec2(c)),
                 high = glm::max(glm::max(Vec2(a), Vec2(b)), Vec2(c));
      cells.for_each(low, high, [&](std::uint64_t key) {
        const auto found = by_cell.find(key);
        if (found == by_cell.end()) return;
        for (const std::uint32_t i : found->second) {
          const Vec2 w = Vec2(places[i].surface_m) - Vec2(a);
          const double s = (w.x * v.y - w.y * v.x) / area, t = (u.x * w.y - u.y * w.x) / area;
          if (s < 0.0 || t < 0.0 || s + t > 1.0) continue;
          const double over_m = a.z + s * (b.z - a.z) + t * (c.z - a.z) - places[i].surface_m.z;
          if (over_m <= noticed_m) continue;
          if (!is_buried[i]) ++result.by_mesh[std::string(mesh)];
          is_buried[i] = true;
          if (over_m <= result.most_m) continue;
          result.most_m = over_m;
          const road::RoadPosition& at = places[i].position;
          result.worst = fmt::format("{:.2f} m of {} ({}) over road {} s={:.1f} t={:.2f}", over_m, mesh,
                                     triangle.material, network.roads[at.road].id, at.s_m, at.t_m);
        }
      });
    }
  result.buried = static_cast<std::size_t>(std::ranges::count(is_buried, true));
  return result;
}

}  // namespace septet::scenery

#pragma once
/// Triangles of a drawn world by the kinds of their objects, for tests.

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/math/plane_cells.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/store.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/engine/road/third_party_road.hpp"
#include "tests/engine/scenery/world/kind_of.hpp"

namespace septet::scenery {

using road::third_party_road;

/// The road and its own parts alone.
inline constexpr RoadWorldOptions bare{.vegetation = false, .buildings = false, .overrun_m = 0.0};

struct DrawnTriangle {
  std::array<Vec3, 3> corners_m;
  std::string material;

  Vec3 across() const { return glm::cross(corners_m[1] - corners_m[0], corners_m[2] - corners_m[0]); }
};

inline std::vector<DrawnTriangle> drawn_triangles(const scene::Store& store, std::string_view name) {
  std::vector<DrawnTriangle> found;
  for (const auto& [id, node] : store.nodes()) {
    const auto* object = std::get_if<scene::ObjectData>(&node.data);
    if (!object || kind_of(node.name) != name) continue;
    const RigidTransform world_from_object{object->transform.position_m, glm::normalize(object->transform.rotation)};
    std::map<std::uint32_t, std::string> materials;
    const scene::GeometryData* geometry = nullptr;
    for (const auto& [link_id, link] : object->links) {
      const scene::Node* target = store.find(link.target);
      if (!target) continue;
      if (link.label == "geometry") geometry = std::get_if<scene::GeometryData>(&target->data);
      if (link.label == "material") materials[link.target_id] = target->name;
    }
    if (!geometry) continue;
    const scene::GeometryLayer* worn = nullptr;
    for (const auto& [layer_id, layer] : geometry->layers)
      if (layer.name == "material") worn = &layer;
    for (std::size_t i = 0; i < geometry->polygons.size(); ++i) {
      const std::string& material = materials[worn ? worn->integers.at(i) : 0];
      const auto& corners = geometry->polygons[i];
      const auto at = [&](std::size_t k) { return world_from_object * Vec3(geometry->vertices_m[corners[k]]); };
      for (std::size_t k = 1; k + 1 < geometry::corner_count(corners); ++k)
        found.push_back({{at(0), at(k), at(k + 1)}, material});
    }
  }
  return found;
}

/// Surfaces over and under a place.
class DrawnHeights {
 public:
  explicit DrawnHeights(std::vector<DrawnTriangle> triangles) : triangles_(std::move(triangles)) {
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      Vec2 low(1e300), high(-1e300);
      for (const Vec3& corner : triangles_[i].corners_m) {
        low = glm::min(low, Vec2(corner));
        high = glm::max(high, Vec2(corner));
      }
      cells.for_each(low, high, [&](std::uint64_t key) { by_cell_[key].push_back(i); });
    }
  }

  std::vector<double> at(const Vec2& p) const {
    std::vector<double> heights;
    const auto cell = by_cell_.find(cells.key_at(p));
    if (cell == by_cell_.end()) return heights;
    for (const std::uint32_t i : cell->second) {
      const auto& [a, b, c] = triangles_[i].corners_m;
      const Vec2 u = Vec2(b) - Vec2(a), v = Vec2(c) - Vec2(a), w = p - Vec2(a);
      const double area = u.x * v.y - u.y * v.x;
      if (std::abs(area) < 1e-6) continue;
      const double s = (w.x * v.y - w.y * v.x) / area, t = (u.x * w.y - u.y * w.x) / area;
      if (s >= -1e-6 && t >= -1e-6 && s + t <= 1.0 + 1e-6) heights.push_back(a.z + s * (b.z - a.z) + t * (c.z - a.z));
    }
    return heights;
  }

 private:
  static constexpr PlaneCells cells{2.0};
  std::vector<DrawnTriangle> triangles_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> by_cell_;
};

}  // namespace septet::scenery

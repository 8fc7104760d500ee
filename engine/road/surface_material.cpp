#include "engine/road/surface_material.hpp"

#include <algorithm>
#include <iterator>

#include "engine/road/lane_geometry.hpp"

namespace septet::road {
namespace {

/// Even-odd rule.
bool holds(const SurfacePatch& patch, const Vec2& point) {
  if (point.x < patch.low_st_m.x || point.x > patch.high_st_m.x || point.y < patch.low_st_m.y ||
      point.y > patch.high_st_m.y)
    return false;
  bool inside = false;
  for (std::size_t i = 0, before = patch.corners_st_m.size() - 1; i < patch.corners_st_m.size();
       before = i++) {
    const Vec2 &a = patch.corners_st_m[i], &b = patch.corners_st_m[before];
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

}  // namespace

const SurfaceMaterial* material_at(const RoadNetwork& network, const RoadPosition& position) {
  const Road& road = network.roads[position.road];
  for (auto patch = road.patches.rbegin(); patch != road.patches.rend(); ++patch)
    if (holds(*patch, {position.s_m, position.t_m})) return &patch->material;
  if (!road.has_materials) return nullptr;
  const LaneSection& section = section_at(road, position.s_m);
  const int id = lanes_at(road, position.s_m, position.t_m).lane_any_type;
  if (id == 0 || !section.has_lane(id)) return nullptr;
  const auto& materials = section.lane(id).materials;
  const auto after = std::ranges::upper_bound(materials, position.s_m, {}, &LaneMaterial::s_m);
  return after == materials.begin() ? nullptr : &std::prev(after)->material;
}

}  // namespace septet::road

#include "engine/road/surface_material.hpp"

#include <algorithm>
#include <iterator>

#include "engine/math/polygon.hpp"
#include "engine/road/lane_geometry.hpp"

namespace septet::road {
namespace {

bool holds(const SurfacePatch& patch, const Vec2& point) {
  if (point.x < patch.low_st_m.x || point.x > patch.high_st_m.x || point.y < patch.low_st_m.y ||
      point.y > patch.high_st_m.y)
    return false;
  return is_inside(patch.corners_st_m, point);
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

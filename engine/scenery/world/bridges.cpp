#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/road/decks.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/bridge_shape.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

using namespace roadside::bridge_shape;

/// Decks narrower than two box girders, or over a road, are one slab, which leaves the clearance that lorries need.
constexpr double girders_width_m = 28.0, slab_m = 0.9, slab_taper_m = 1.2;

bool is_slab(const road::RoadStructure& bridge, const road::RoadExtent& extent) {
  return bridge.over_road || extent.left_t_m - extent.right_t_m < girders_width_m;
}

/// Underside from the left edge beam's foot to the right one's, seen along the road.
std::vector<std::pair<double, double>> underside_of(bool slab, double left, double right) {
  if (slab) {
    const double taper = std::min(slab_taper_m, 0.4 * (left - right));
    return {{left - taper, -slab_m}, {right + taper, -slab_m}};
  }
  return {{left - 2.6, -0.8},   {left - 4.2, -2.6},   {left - 12.0, -2.6}, {left - 13.6, -0.8},
          {right + 13.6, -0.8}, {right + 12.0, -2.6}, {right + 4.2, -2.6}, {right + 2.6, -0.8}};
}

/// Adds the deck's edge beams and its underside, seen from below and from afar.
void add_deck(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile,
              const road::RoadStructure& bridge) {
  const std::vector<double> along = stations(tile, bridge.over_road ? 4.0 : 16.0);
  const bool slab = is_slab(bridge, road::road_extent(world.roads.road(tile.road), tile.middle_m()));
  std::vector<std::vector<std::uint32_t>> rows;
  for (const double s : along) {
    const road::RoadExtent extent = road::road_extent(world.roads.road(tile.road), s);
    const double left = extent.left_t_m + overhang_m, right = extent.right_t_m - overhang_m;
    // Section from the upper left edge, counter-clockwise seen along the road.
    std::vector<std::pair<double, double>> section{
        {extent.left_t_m, 0.0}, {extent.left_t_m, 0.12}, {left, 0.12}, {left, edge_foot_m}};
    const auto underside = underside_of(slab, left, right);
    section.insert(section.end(), underside.begin(), underside.end());
    section.insert(section.end(), {{right, edge_foot_m}, {right, 0.12}});
    auto& row = rows.emplace_back();
    for (const auto& [t, up] : section) row.push_back(builder.vertex(world.roads.local(tile, s, t, up)));
    row.push_back(builder.vertex(world.roads.local(tile, s, extent.right_t_m, 0.12)));
    row.push_back(builder.vertex(world.roads.local(tile, s, extent.right_t_m, 0.0)));
  }
  builder.material = index_of(Ground::concrete);
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    for (std::size_t k = 0; k + 1 < rows[i].size(); ++k) {
      const auto v0 = static_cast<float>((along[i] - tile.s0_m) / 4.0),
                 v1 = static_cast<float>((along[i + 1] - tile.s0_m) / 4.0);
      builder.quad(rows[i][k], rows[i + 1][k], rows[i + 1][k + 1], rows[i][k + 1],
                   {{{v0, 0}, {v1, 0}, {v1, 0.4f}, {v0, 0.4f}}});
    }
}

/// True where lanes lie under a pier's foot or right beside it.
bool stands_on_lanes(const WorldContext& world, const Vec3& head) {
  constexpr double clear_m = 2.6;
  bool on_lanes = false;
  world.terrain.lanes().for_each(
      Vec2(head) - clear_m, Vec2(head) + clear_m, [&](const roadside::LaneLevels::Place& place) {
        if (place.most_m < head.z - road::least_rise_m / 2 && glm::distance(place.p, Vec2(head)) < clear_m)
          on_lanes = true;
      });
  return on_lanes;
}

void add_column(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double s, double t,
                double under_m, const Vec2& half_m) {
  const Vec3 head = world.roads.point(tile.road, s, t, -under_m);
  const double foot = world.terrain.height_m(Vec2(head)) - 2.0;
  if (foot > head.z - 0.5 || stands_on_lanes(world, head)) return;
  const glm::vec3 p = world.roads.local(tile, head);
  geometry::PolygonMesh pier = geometry::box({p.x - half_m.x, p.y - half_m.y, p.z - (head.z - foot)},
                                             {p.x + half_m.x, p.y + half_m.y, p.z}, 0.12f);
  geometry::project_box_uvs(pier, 0.25f);
  builder.append(pier, glm::mat4(1.0f), true);
}

/// Adds a pier for each box girder; a slab gets one every 14 m at most, that leave lanes below free.
void add_piers(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile,
               const road::RoadStructure& bridge) {
  const road::RoadExtent extent = road::road_extent(world.roads.road(tile.road), tile.middle_m());
  const bool slab = is_slab(bridge, extent);
  const int spans = bridge.over_road ? static_cast<int>(std::ceil(bridge.length_m / 14.0))
                                     : std::max(2, static_cast<int>(std::lround(bridge.length_m / 36.0)));
  for (int i = 1; i < spans; ++i) {
    const double s = bridge.s_m + bridge.length_m * i / spans;
    if (s <= tile.s0_m || s > tile.s1_m) continue;
    if (slab) {
      const double width = extent.left_t_m - extent.right_t_m, half_m = std::min(3.0, 0.3 * width);
      const int beside = std::max(1, static_cast<int>(std::ceil(width / girders_width_m)));
      for (int k = 0; k < beside; ++k)
        add_column(builder, world, tile, s, extent.right_t_m + width * (k + 0.5) / beside, slab_m - 0.1,
                   {0.6, bridge.over_road ? std::min(half_m, 1.2) : half_m});
    } else {
      for (const double t : {extent.left_t_m - 6.8, extent.right_t_m + 6.8})
        add_column(builder, world, tile, s, t, 2.4, {0.9, 3.0});
    }
  }
}

/// Adds walls at both ends that hold the road's bank.
void add_abutment(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double s) {
  const road::RoadExtent extent = road::road_extent(world.roads.road(tile.road), s);
  const double left = extent.left_t_m + overhang_m + 0.6, right = extent.right_t_m - overhang_m - 0.6;
  const glm::vec3 a = world.roads.local(tile, s, left, -0.2), b = world.roads.local(tile, s, right, -0.2);
  const float depth = 9.0f;
  geometry::PolygonMesh wall = geometry::box({std::min(a.x, b.x) - 1.5f, b.y, std::min(a.z, b.z) - depth},
                                             {std::max(a.x, b.x) + 1.5f, a.y, std::min(a.z, b.z)});
  geometry::project_box_uvs(wall, 0.25f);
  builder.append(wall, glm::mat4(1.0f), true);
}

}  // namespace

void build_bridges(const WorldContext& world) {
  for (const RoadTile& tile : world.roads.tiles(160.0)) {
    if (!tile.on_bridge) continue;
    const road::RoadStructure& bridge =
        *world.roads.structure_at(tile.road, tile.middle_m(), road::RoadStructure::Kind::bridge);
    MeshBuilder builder;
    add_deck(builder, world, tile, bridge);
    builder.material = index_of(Ground::concrete);
    add_piers(builder, world, tile, bridge);
    for (const double s : {bridge.s_m, bridge.s_m + bridge.length_m})
      if (s >= tile.s0_m - 0.01 && s <= tile.s1_m + 0.01) add_abutment(builder, world, tile, s);
    geometry::PolygonMesh mesh = builder.take();
    geometry::crease_by_angle(mesh, 0.4f);
    add_tile_mesh(world, tile, "bridge", mesh, 0.0f, 4000.0f, true);
  }
}

}  // namespace septet::scenery

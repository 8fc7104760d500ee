#include <array>
#include <cmath>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/bridge_shape.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

using namespace roadside::bridge_shape;

/// The deck's edge beams, its underside with two box girders, seen from below and from afar.
void add_deck(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile) {
  const std::vector<double> along = stations(tile, 16.0);
  std::vector<std::vector<std::uint32_t>> rows;
  for (const double s : along) {
    const road::RoadExtent extent = road::road_extent(world.roads.road(tile.road), s);
    const double left = extent.left_t_m + overhang_m, right = extent.right_t_m - overhang_m;
    // Round the section from the upper left edge, counter-clockwise seen along the road.
    const std::array<std::pair<double, double>, 14> section{{{extent.left_t_m, 0.0},
                                                             {extent.left_t_m, 0.12},
                                                             {left, 0.12},
                                                             {left, edge_foot_m},
                                                             {left - 2.6, -0.8},
                                                             {left - 4.2, -2.6},
                                                             {left - 12.0, -2.6},
                                                             {left - 13.6, -0.8},
                                                             {right + 13.6, -0.8},
                                                             {right + 12.0, -2.6},
                                                             {right + 4.2, -2.6},
                                                             {right + 2.6, -0.8},
                                                             {right, edge_foot_m},
                                                             {right, 0.12}}};
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

void add_column(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double s, double t,
                double half_along, double half_across) {
  const Vec3 head = world.roads.point(tile.road, s, t, -2.4);
  const double foot = world.terrain.height_m(Vec2(head)) - 2.0;
  if (foot > head.z - 0.5) return;
  const glm::vec3 p = world.roads.local(tile, head);
  geometry::PolygonMesh pier = geometry::box({p.x - half_along, p.y - half_across, p.z - (head.z - foot)},
                                             {p.x + half_along, p.y + half_across, p.z}, 0.12f);
  geometry::project_box_uvs(pier, 0.25f);
  builder.append(pier, glm::mat4(1.0f), true);
}

/// Walls at both ends that hold the road's bank.
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
    add_deck(builder, world, tile);
    builder.material = index_of(Ground::concrete);
    const int spans = std::max(2, static_cast<int>(std::lround(bridge.length_m / 36.0)));
    const road::RoadExtent extent = road::road_extent(world.roads.road(tile.road), tile.middle_m());
    for (int i = 1; i < spans; ++i) {
      const double s = bridge.s_m + bridge.length_m * i / spans;
      if (s <= tile.s0_m || s > tile.s1_m) continue;
      for (const double t : {extent.left_t_m - 6.8, extent.right_t_m + 6.8})
        add_column(builder, world, tile, s, t, 0.9, 3.0);
    }
    for (const double s : {bridge.s_m, bridge.s_m + bridge.length_m})
      if (s >= tile.s0_m - 0.01 && s <= tile.s1_m + 0.01) add_abutment(builder, world, tile, s);
    geometry::PolygonMesh mesh = builder.take();
    geometry::crease_by_angle(mesh, 0.4f);
    add_tile_mesh(world, tile, "bridge", mesh, 0.0f, 4000.0f, true);
  }
}

}  // namespace septet::scenery

#include <array>
#include <cmath>
#include <span>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/noise.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/scenery/world/far_road.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

/// A column of the strip beside the road: distance from the asphalt and how its height is found.
struct Column {
  double out_m;
  double fall_m;   ///< Below the asphalt's edge.
  double of_land;  ///< 0: by the fall; 1: by the land, plus lift.
  double lift_m;
};

/// Gravel shoulder, ditch and bank; then over the land's coarse grid and finally under it.
constexpr std::array<Column, 8> near_columns{{{0, 0.0, 0, 0},
                                              {0.7, 0.05, 0, 0},
                                              {2.2, 0.35, 0, 0},
                                              {4.2, 1.15, 0, 0},
                                              {5.6, 1.15, 0, 0},
                                              {9.5, 0.6, 0.7, 0.2},
                                              {20, 0, 1, 0.35},
                                              {38, 0, 1, -1.2}}};
constexpr std::array<Column, 4> far_columns{{{0, 0.0, 0, 0}, {4.5, 1.0, 0, 0}, {20, 0, 1, 0.35}, {38, 0, 1, -1.2}}};
/// Beside a tunnel's mouth the bank is fine further out, where the grid is left out.
constexpr std::array<Column, 11> mouth_columns{{{0, 0.0, 0, 0},
                                                {0.7, 0.05, 0, 0},
                                                {2.2, 0.25, 0.0, 0},
                                                {4.2, 0.4, 0.3, 0},
                                                {9.5, 0, 1, 0.0},
                                                {17, 0, 1, 0},
                                                {25, 0, 1, 0},
                                                {34, 0, 1, 0.05},
                                                {45, 0, 1, 0.1},
                                                {58, 0, 1, 0.35},
                                                {70, 0, 1, -2.0}}};

glm::vec3 column_point(const WorldContext& world, const RoadTile& tile, double s, double edge_t, double side,
                       const Column& column) {
  const Vec3 edge = world.roads.point(tile.road, s, edge_t);
  const road::RoadPoint axis = world.roads.at(tile.road, s, 0.0);
  const Vec2 outward(-std::sin(axis.heading_rad) * side, std::cos(axis.heading_rad) * side);
  const Vec2 p = Vec2(edge) + outward * column.out_m;
  double z = edge.z - column.fall_m;
  if (column.of_land > 0.0) z = std::lerp(z, world.terrain.height_m(p) + column.lift_m, column.of_land);
  // Where a ramp runs beside, the strip passes below its pavement.
  if (column.out_m > 0.0) {
    const Nearest near = world.terrain.nearest(p);
    if (near.found && near.road != tile.road && near.outside_m < 0.6) z = std::min(z, near.edge_z_m - 0.4);
  }
  return world.roads.local(tile, Vec3(p, z));
}

void draw_side(const WorldContext& world, const RoadTile& tile, double side, double step_m,
               std::span<const Column> columns, MeshBuilder& builder, bool near) {
  const std::vector<double> along = stations(tile, step_m);
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const road::RoadExtent extent = road::road_extent(world.roads.road(tile.road), along[i]);
    const double edge_t = side > 0 ? extent.left_t_m : extent.right_t_m;
    std::uint32_t row = 0;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::uint32_t v = builder.vertex(column_point(world, tile, along[i], edge_t, side, columns[k]));
      if (k == 0) row = v;
    }
    if (i > 0)
      for (std::uint32_t k = 0; k + 1 < columns.size(); ++k) {
        builder.material = index_of(!near ? Ground::far_verge : k == 0 ? Ground::gravel : Ground::verge);
        const auto u0 = static_cast<float>(columns[k].out_m / 3.5), u1 = static_cast<float>(columns[k + 1].out_m / 3.5);
        const auto v0 = static_cast<float>((along[i - 1] - tile.s0_m) / 3.5),
                   v1 = static_cast<float>((along[i] - tile.s0_m) / 3.5);
        if (side > 0)
          builder.quad(first + k, row + k, row + k + 1, first + k + 1, {{{u0, v0}, {u0, v1}, {u1, v1}, {u1, v0}}});
        else
          builder.quad(first + k, first + k + 1, row + k + 1, row + k, {{{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}}});
      }
    first = row;
  }
}

bool is_at_mouth(const WorldContext& world, const RoadTile& tile) {
  for (const road::RoadStructure& structure : world.roads.road(tile.road).structures)
    if (structure.kind == road::RoadStructure::Kind::tunnel)
      for (const double mouth : {structure.s_m, structure.s_m + structure.length_m})
        if (tile.s0_m < mouth + 45.0 && tile.s1_m > mouth - 45.0) return true;
  return false;
}

/// Both sides of a tile; finer in its steps, and further out, at a tunnel's mouth.
void draw_sides(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double step_m, bool near) {
  if (tile.in_tunnel || tile.on_bridge) return;
  const bool mouth = is_at_mouth(world, tile);
  std::span<const Column> columns = far_columns;
  if (near) columns = near_columns;
  if (mouth) columns = mouth_columns;
  for (const double side : {1.0, -1.0})
    draw_side(world, tile, side, mouth ? step_m / 2 : step_m, columns, builder, near);
}

}  // namespace

void draw_far_verges(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double step_m) {
  draw_sides(builder, world, tile, step_m, false);
}

void build_verges(const WorldContext& world) {
  for (const RoadTile& tile : world.roads.tiles(160.0)) {
    MeshBuilder near;
    draw_sides(near, world, tile, 16.0, true);
    if (!near.mesh().polygons.empty()) add_tile_mesh(world, tile, "verge", near.mesh(), 0.0f, road_near_m);
  }
}

}  // namespace septet::scenery

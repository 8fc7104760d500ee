#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/noise.hpp"
#include "engine/road/decks.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/town.hpp"
#include "engine/scenery/world/covered_lanes.hpp"
#include "engine/scenery/world/far_road.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

/// Column of the strip beside the road: distance from the asphalt, and rule for its height.
struct Column {
  double out_m;
  double fall_m;   ///< Depth below the asphalt's edge.
  double of_land;  ///< Weight of the land plus lift; 0: by `fall_m` alone.
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
/// Columns in a town, where lawn continues nearly level from the pavement.
constexpr std::array<Column, 6> town_columns{
    {{0, 0.0, 0, 0}, {0.6, 0.03, 0, 0}, {4, 0.08, 0, 0}, {11, 0.15, 0, 0}, {20, 0, 1, 0.35}, {38, 0, 1, -1.2}}};
/// Columns beside a tunnel's mouth, where the bank is fine further out, as the grid is left out.
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

Vec2 outwards(const WorldContext& world, const RoadTile& tile, double s, double side) {
  const double heading = world.roads.at(tile.road, s, 0.0).heading_rad;
  return {-std::sin(heading) * side, std::cos(heading) * side};
}

Vec3 column_point(const WorldContext& world, const RoadTile& tile, double s, double edge_t, double side,
                  const Column& column, bool is_limited) {
  const Vec3 edge = world.roads.point(tile.road, s, edge_t);
  const Vec2 p = Vec2(edge) + outwards(world, tile, s, side) * column.out_m;
  double z = edge.z - column.fall_m;
  if (column.of_land > 0.0) z = std::lerp(z, world.terrain.height_m(p) + column.lift_m, column.of_land);
  // Beside a ramp the strip passes below its pavement.
  if (column.out_m > 0.0 && !is_limited) {
    const Nearest near = world.terrain.nearest(p);
    if (near.found && near.road != tile.road && near.outside_m < 0.6) z = std::min(z, near.edge_z_m - 0.4);
  }
  return {p, z};
}

/// Height from which a lane counts as carried over the strip.
constexpr double overhead_m = road::least_rise_m;

/// Reach of a strip outwards of a road's edge.
struct Free {
  double out_m = 1e9;
  std::optional<double> z_m;  ///< Height of the other road that ends it.
};
Free free_beside(const WorldContext& world, const RoadTile& tile, double s, double edge_t, double side, double most_m) {
  const road::RoadNetwork& network = world.roads.network();
  const road::RoadPoint at = world.roads.at(tile.road, s, edge_t);
  const Vec2 edge(at.position_m), out = outwards(world, tile, s, side);
  // Rows inside a bend meet in its middle.
  Free free;
  if (at.curvature_per_m * side > 1e-4) free.out_m = 0.85 / (at.curvature_per_m * side);
  const auto holding = [&](double out_m) -> std::optional<road::Location> {
    for (const road::Location& location : road::roads_holding(network, edge + out * out_m)) {
      const bool own = location.position.road == tile.road && std::abs(location.position.s_m - s) < over_itself_m;
      // Strips continue below a deck.
      if (!own && road::evaluate(network, location.position).position_m.z < at.position_m.z + overhead_m)
        return location;
    }
    return std::nullopt;
  };
  constexpr double step_m = 0.7;
  double clear_m = 0.0;
  for (double out_m = 0.05; out_m < std::min(most_m, free.out_m); out_m += step_m) {
    auto there = holding(out_m);
    if (!there) {
      clear_m = out_m;
      continue;
    }
    double taken_m = out_m;
    for (int round = 0; round < 5; ++round) {
      const double middle = 0.5 * (clear_m + taken_m);
      if (const auto nearer = holding(middle)) {
        taken_m = middle;
        there = nearer;
      } else {
        clear_m = middle;
      }
    }
    return {clear_m, road::evaluate(network, there->position).position_m.z};
  }
  return free;
}

Column mixed(const Column& a, const Column& b, double out_m) {
  const double share = (out_m - a.out_m) / (b.out_m - a.out_m);
  return {out_m, std::lerp(a.fall_m, b.fall_m, share), std::lerp(a.of_land, b.of_land, share),
          std::lerp(a.lift_m, b.lift_m, share)};
}

double edge_t_m(const WorldContext& world, const RoadTile& tile, double s, double side) {
  const road::RoadExtent extent = road::road_extent(world.roads.road(tile.road), s);
  return side > 0 ? extent.left_t_m : extent.right_t_m;
}

/// Reach at each station; between stations the strip's end moves no further than they lie apart.
std::vector<Free> free_along(const WorldContext& world, const RoadTile& tile, const std::vector<double>& along,
                             double side, double most_m, bool among_roads) {
  std::vector<Free> result(along.size());
  if (!among_roads) return result;
  for (std::size_t i = 0; i < along.size(); ++i)
    result[i] = free_beside(world, tile, along[i], edge_t_m(world, tile, along[i], side), side, most_m);
  const auto limit = [&](Free& free, const Free& beside, double apart_m) {
    if (free.out_m > beside.out_m + apart_m) free = {beside.out_m + apart_m, std::nullopt};
  };
  for (std::size_t i = 1; i < along.size(); ++i) limit(result[i], result[i - 1], along[i] - along[i - 1]);
  for (std::size_t i = along.size(); i-- > 1;) limit(result[i - 1], result[i], along[i] - along[i - 1]);
  return result;
}

/// Row of points from the road's edge outwards. Towards another road the strip ends at that one's edge. Where earth
/// would stand too steeply over a lower road it begins at the foot of a wall.
std::vector<Vec3> row_of(const WorldContext& world, const RoadTile& tile, double s, double side,
                         std::span<const Column> columns, const Free& free, bool among_roads) {
  const double edge_t = edge_t_m(world, tile, s, side);
  const Vec3 edge = world.roads.point(tile.road, s, edge_t);
  const Vec2 out = outwards(world, tile, s, side);
  std::vector<Vec3> row;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double out_m = std::min(columns[k].out_m, free.out_m);
    if (!free.z_m || k == 0) {
      Column column = columns[k];
      for (std::size_t j = 1; j <= k && column.out_m > out_m; ++j)
        if (columns[j].out_m >= out_m) column = mixed(columns[j - 1], columns[j], out_m);
      row.push_back(column_point(world, tile, s, edge_t, side, column, among_roads));
    } else {
      // Slope to the other road's edge.
      const double share = free.out_m > 1e-6 ? out_m / free.out_m : 1.0;
      row.emplace_back(Vec2(edge) + out * out_m, std::lerp(edge.z, *free.z_m, share) - 0.012);
    }
    row.back().z = world.terrain.lanes().limited_m(Vec2(row.back()), row.back().z);
  }
  return row;
}

/// True where cars drive along this edge of a junction's road: ground between two of them is paved.
bool is_driven_along(const road::Road& road, const RoadTile& tile, double side) {
  if (road.junction == road::no_index) return false;
  const road::LaneSection& section = road::section_at(road, tile.middle_m());
  const int outermost = side > 0 ? section.left_count : -section.right_count;
  return outermost == 0 || road::is_drivable(section.lane(outermost).type);
}

/// True where a pavement goes round a corner along this edge: behind it lies lawn.
bool is_beside_corner(const WorldContext& world, const RoadTile& tile, double s, double side, const Vec3& edge) {
  constexpr double beside_m = 0.3, least_rise_m = 0.05;
  const Vec2 p = Vec2(edge) + outwards(world, tile, s, side) * beside_m;
  return world.raised.ground_at(p, edge.z) > edge.z + least_rise_m;
}

/// True where another road may lie within the strip beside this tile.
bool is_among_roads(const WorldContext& world, const RoadTile& tile) {
  const road::Road& road = world.roads.road(tile.road);
  if (road.junction != road::no_index) return true;
  constexpr double near_m = 60.0;
  const auto meets = [](const road::RoadLink& link) { return link.junction != road::no_index; };
  return (meets(road.predecessor) && tile.s0_m < near_m) ||
         (meets(road.successor) && tile.s1_m > road.length_m - near_m);
}

/// Ground beside one side of a tile: a row of points for each station, from the road outwards.
struct Strip {
  std::vector<double> along;
  std::span<const Column> columns;
  bool among_roads = false;
  std::vector<Free> free;
  std::vector<std::vector<Vec3>> rows;
};

Strip strip_of(const WorldContext& world, const RoadTile& tile, double side, std::vector<double> along,
               std::span<const Column> columns, bool among_roads) {
  Strip strip{std::move(along), columns, among_roads, {}, {}};
  strip.free = free_along(world, tile, strip.along, side, columns.back().out_m, among_roads);
  for (std::size_t i = 0; i < strip.along.size(); ++i)
    strip.rows.push_back(row_of(world, tile, strip.along[i], side, columns, strip.free[i], among_roads));
  return strip;
}

void draw_strip(const WorldContext& world, const RoadTile& tile, double side, Strip& strip, MeshBuilder& builder,
                bool near, const std::vector<Covered>& covered) {
  const std::vector<double>& along = strip.along;
  const std::span<const Column> columns = strip.columns;
  const auto left_out = lower_below_lanes(covered);
  std::uint32_t first = 0;
  const bool driven = is_driven_along(world.roads.road(tile.road), tile, side) &&
                      std::ranges::any_of(strip.free, [](const Free& at) { return at.z_m.has_value(); });
  constexpr double island_m = 12.0;
  const bool lawn = columns.data() == town_columns.data();
  for (std::size_t i = 0; i < along.size(); ++i) {
    std::uint32_t row = 0;
    const bool paved = driven && strip.among_roads && i > 0 &&
                       (strip.free[i - 1].out_m < island_m || strip.free[i].out_m < island_m) &&
                       !is_beside_corner(world, tile, along[i], side, strip.rows[i][0]);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::uint32_t v = builder.vertex(world.roads.local(tile, strip.rows[i][k]));
      if (k == 0) row = v;
    }
    if (i > 0)
      for (std::uint32_t k = 0; k + 1 < columns.size(); ++k) {
        const std::vector<Vec3>&last = strip.rows[i - 1], &here = strip.rows[i];
        if (strip.among_roads && glm::distance(last[k], last[k + 1]) < 0.02 &&
            glm::distance(here[k], here[k + 1]) < 0.02)
          break;
        if (left_out.contains({i, k})) continue;
        builder.material = index_of(!near ? Ground::far_verge : k == 0 && !lawn ? Ground::gravel : Ground::verge);
        if (paved) builder.material = index_of(Ground::asphalt_plain);
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

/// Draws the walls along the road's edge where the ground beside it begins lower.
void draw_retaining_wall(const WorldContext& world, const RoadTile& tile, double side, const Strip& strip,
                         MeshBuilder& builder, bool near) {
  constexpr double least_m = 0.05, texture_m = 4.0;
  const auto top_of = [&](std::size_t i) {
    return world.roads.point(tile.road, strip.along[i], edge_t_m(world, tile, strip.along[i], side));
  };
  builder.material = index_of(near ? Ground::concrete : Ground::far_concrete);
  for (std::size_t i = 1; i < strip.rows.size(); ++i) {
    const std::array<Vec3, 2> top{top_of(i - 1), top_of(i)}, foot{strip.rows[i - 1][0], strip.rows[i][0]};
    if (std::max(top[0].z - foot[0].z, top[1].z - foot[1].z) < least_m) continue;
    std::array<glm::vec3, 4> corners{world.roads.local(tile, top[0]), world.roads.local(tile, foot[0]),
                                     world.roads.local(tile, foot[1]), world.roads.local(tile, top[1])};
    geometry::CornerUvs uvs{};
    for (std::size_t k = 0; k < 4; ++k)
      uvs[k] = {static_cast<float>((k < 2 ? strip.along[i - 1] : strip.along[i]) - tile.s0_m) / texture_m,
                -corners[k].z / static_cast<float>(texture_m)};
    if (side > 0) {
      std::ranges::reverse(corners);
      std::ranges::reverse(uvs);
    }
    builder.patch(corners[0], corners[1], corners[2], corners[3], uvs);
  }
}

bool is_at_mouth(const WorldContext& world, const RoadTile& tile) {
  for (const road::RoadStructure& structure : world.roads.road(tile.road).structures)
    if (structure.kind == road::RoadStructure::Kind::tunnel)
      for (const double mouth : {structure.s_m, structure.s_m + structure.length_m})
        if (tile.s0_m < mouth + 45.0 && tile.s1_m > mouth - 45.0) return true;
  return false;
}

/// Draws both sides of a tile; in finer steps, and further out, at a tunnel's mouth.
void draw_sides(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double step_m, bool near) {
  if (tile.in_tunnel || tile.on_bridge) return;
  const bool mouth = is_at_mouth(world, tile), among_roads = near && is_among_roads(world, tile);
  std::span<const Column> columns = far_columns;
  if (near) columns = near_columns;
  if (near && roadside::is_in_town(world.roads.network(), tile.road, tile.middle_m())) columns = town_columns;
  if (mouth) columns = mouth_columns;
  const auto along = [&](bool close) {
    return near && !mouth ? roadside::close_stations(world.roads, tile, close ? step_m / 4 : step_m)
                          : stations(tile, mouth ? step_m / 2 : step_m);
  };
  for (const double side : {1.0, -1.0}) {
    Strip strip = strip_of(world, tile, side, along(among_roads), columns, among_roads);
    const auto covered_by = [&] {
      return near ? covered_lanes(world, tile, strip.along, strip.rows, strip.among_roads) : std::vector<Covered>{};
    };
    std::vector<Covered> covered = covered_by();
    if (!covered.empty() && !mouth && !among_roads) {  // Reaches another road all the same.
      strip = strip_of(world, tile, side, along(true), columns, true);
      covered = covered_by();
    }
    draw_strip(world, tile, side, strip, builder, near, covered);
    draw_retaining_wall(world, tile, side, strip, builder, near);
  }
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

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/tunnel_shape.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

using namespace roadside::tunnel_shape;

/// Point of the inside of one tube, up and across, from the foot of its outer wall over the ceiling to the foot of the
/// wall in the middle. `edge_t` of tube_section: the asphalt's edge.
struct TubePoint {
  double t_m, up_m;
  Ground ground;  ///< Ground of the strip to the next point.
};
std::array<TubePoint, 7> tube_section(double edge_t) {
  const double side = edge_t > 0 ? 1.0 : -1.0;
  const double wall = edge_t + side * wall_clear_m, middle = side * middle_wall_m;
  return {{{wall, -0.2, Ground::tiles_tunnel},
           {wall, 3.2, Ground::concrete_tunnel},
           {wall, haunch_m, Ground::concrete_tunnel},
           {wall - side * haunch_width_m, ceiling_m, Ground::concrete_tunnel},
           {middle, ceiling_m, Ground::concrete_tunnel},
           {middle, 3.2, Ground::tiles_tunnel},
           {middle, -0.2, Ground::tiles_tunnel}}};
}

void add_tube(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, bool left) {
  const std::vector<double> along = stations(tile, 20.0);
  std::vector<std::array<std::uint32_t, 7>> rows;
  std::array<TubePoint, 7> section{};
  for (const double s : along) {
    const road::RoadExtent extent = road::road_extent(world.roads.road(tile.road), s);
    section = tube_section(left ? extent.left_t_m : extent.right_t_m);
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < section.size(); ++k)
      row[k] = builder.vertex(world.roads.local(tile, s, section[k].t_m, section[k].up_m));
  }
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    for (std::size_t k = 0; k + 1 < section.size(); ++k) {
      builder.material = index_of(section[k].ground);
      const auto u0 = static_cast<float>((along[i] - tile.s0_m) / 4.0),
                 u1 = static_cast<float>((along[i + 1] - tile.s0_m) / 4.0);
      const auto v1 = static_cast<float>(
          std::hypot(section[k + 1].t_m - section[k].t_m, section[k + 1].up_m - section[k].up_m) / 4.0);
      if (!left)
        builder.quad(rows[i][k], rows[i][k + 1], rows[i + 1][k + 1], rows[i + 1][k],
                     {{{u0, v1}, {u0, 0}, {u1, 0}, {u1, v1}}});
      else
        builder.quad(rows[i][k], rows[i + 1][k], rows[i + 1][k + 1], rows[i][k + 1],
                     {{{u0, v1}, {u1, v1}, {u1, 0}, {u0, 0}}});
    }
}

/// Adds rows of lamps below the ceiling; signs and niches along the walls.
void add_fittings(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile) {
  const road::RoadExtent extent = road::road_extent(world.roads.road(tile.road), tile.middle_m());
  const auto quad = [&](double s0, double s1, double t0, double t1, double up, bool down) {
    const glm::vec3 a = world.roads.local(tile, s0, t1, up), b = world.roads.local(tile, s0, t0, up),
                    c = world.roads.local(tile, s1, t0, up), d = world.roads.local(tile, s1, t1, up);
    if (down) builder.patch(a, d, c, b);
  };
  for (double s = std::ceil(tile.s0_m / 8.0) * 8.0; s + 2.4 < tile.s1_m; s += 8.0)
    for (const double edge : {extent.left_t_m, extent.right_t_m})
      for (const double share : {0.27, 0.70}) {
        builder.material = index_of(Ground::lamp_tunnel);
        const double t = edge * share;
        quad(s, s + 2.4, t - 0.16, t + 0.16, ceiling_m - 0.10, true);
      }
  builder.material = index_of(Ground::exit_sign);
  for (double s = std::ceil(tile.s0_m / 50.0) * 50.0; s + 1.5 < tile.s1_m; s += 50.0)
    for (const double edge : {extent.left_t_m, extent.right_t_m}) {
      const double side = edge > 0 ? 1.0 : -1.0, t = edge + side * (wall_clear_m - 0.06);
      // Seen from the carriageway, so its left is towards +s on the left-hand wall.
      const double first = side > 0 ? s + 1.2 : s, second = side > 0 ? s : s + 1.2;
      builder.patch(world.roads.local(tile, second, t, 1.0), world.roads.local(tile, first, t, 1.0),
                    world.roads.local(tile, first, t, 1.6), world.roads.local(tile, second, t, 1.6));
    }
}

/// Adds the wall across the hill's face: openings for both tubes, wings along the cutting.
void add_portal(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double mouth_s,
                double outwards) {
  const road::RoadExtent extent = road::road_extent(world.roads.road(tile.road), mouth_s);
  const double left_wall = extent.left_t_m + wall_clear_m, right_wall = extent.right_t_m - wall_clear_m;
  std::vector<double> columns;
  for (double t = extent.left_t_m + portal_out_m; t > left_wall + 4.0; t -= 6.0) columns.push_back(t);
  columns.insert(columns.end(), {left_wall, left_wall - haunch_width_m, middle_wall_m, -middle_wall_m,
                                 right_wall + haunch_width_m, right_wall});
  for (double t = right_wall - 6.0; t > extent.right_t_m - portal_out_m; t -= 6.0) columns.push_back(t);
  const auto ground = [&](double s, double t) {
    const Vec3 p = world.roads.point(tile.road, s, t);
    return world.terrain.height_m(Vec2(p)) - p.z;
  };
  // Height of the opening's edge just outside (left of) and inside each column.
  const auto lintel = [&](double t) -> double {
    if (t > left_wall + 0.01 || t < right_wall - 0.01 || std::abs(t) < middle_wall_m - 0.01) return -1.0;
    const double edge = t > 0 ? left_wall - t : t - right_wall;
    return edge < 0.01 ? haunch_m : ceiling_m;
  };
  const double face = mouth_s + outwards * portal_before_m;
  for (std::size_t k = 0; k + 1 < columns.size(); ++k) {
    const double t0 = columns[k], t1 = columns[k + 1], middle = 0.5 * (t0 + t1);
    const bool open = lintel(middle) > 0.0;
    const auto low = [&](double t) {
      return open ? (std::abs(t - left_wall) < 0.01 || std::abs(t - right_wall) < 0.01 ? haunch_m : ceiling_m)
                  : std::min(ground(mouth_s + outwards * 1.5, t), 0.0) - 2.0;
    };
    const auto high = [&](double t) {
      return std::max(ground(mouth_s - outwards * 1.5, t), t < left_wall + 1.0 && t > right_wall - 1.0 ? 8.6 : 0.0) +
             0.9;
    };
    const auto at = [&](double t, double up) {
      return world.roads.local(tile, world.roads.point(tile.road, face, t) + Vec3(0, 0, up));
    };
    const auto back = [&](double t, double up) {
      return world.roads.local(tile, world.roads.point(tile.road, face - outwards * 0.9, t) + Vec3(0, 0, up));
    };
    const glm::vec3 a = at(t0, low(t0)), b = at(t1, low(t1)), c = at(t1, high(t1)), d = at(t0, high(t0));
    const auto u0 = static_cast<float>(t0 / 4), u1 = static_cast<float>(t1 / 4);
    const geometry::CornerUvs uvs{{{u0, static_cast<float>(-low(t0) / 4)},
                                   {u1, static_cast<float>(-low(t1) / 4)},
                                   {u1, static_cast<float>(-high(t1) / 4)},
                                   {u0, static_cast<float>(-high(t0) / 4)}}};
    builder.material = index_of(Ground::concrete);
    const glm::vec3 c2 = back(t1, high(t1)), d2 = back(t0, high(t0));
    if (outwards < 0) {  // Seen by a driver towards greater s: left is left.
      builder.patch(a, b, c, d, uvs);
      builder.patch(d, c, c2, d2);
    } else {
      builder.patch(b, a, d, c, {{uvs[1], uvs[0], uvs[3], uvs[2]}});
      builder.patch(c, d, d2, c2);
    }
  }
}

/// Adds the land behind a portal, where the coarse grid is left out.
void add_cap(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double mouth_s, double outwards) {
  const road::RoadExtent extent = road::road_extent(world.roads.road(tile.road), mouth_s);
  constexpr int rows = 7, columns = 17;
  const double left = extent.left_t_m + 72.0, right = extent.right_t_m - 72.0;
  builder.material = index_of(Ground::verge);
  std::uint32_t first = 0;
  for (int i = 0; i <= rows; ++i)
    for (int k = 0; k <= columns; ++k) {
      const double s = mouth_s - outwards * (0.3 + 8.0 * i),
                   t = std::lerp(left, right, static_cast<double>(k) / columns);
      const Vec2 p(world.roads.point(tile.road, s, t));
      const bool hem = i == rows || k == 0 || k == columns;
      const std::uint32_t v =
          builder.vertex(world.roads.local(tile, Vec3(p, world.terrain.height_m(p) + (hem ? -1.5 : 0.3))));
      if (i == 0 && k == 0) first = v;
    }
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t k = 0; k < columns; ++k) {
      const std::uint32_t a = first + i * (columns + 1) + k, b = a + columns + 1;
      const auto u = static_cast<float>(k) * 2.0f, v = static_cast<float>(i) * 2.0f;
      // Rows run into the hill, columns to the right.
      if (outwards < 0)
        builder.quad(a, a + 1, b + 1, b, {{{u, v}, {u + 2, v}, {u + 2, v + 2}, {u, v + 2}}});
      else
        builder.quad(a, b, b + 1, a + 1, {{{u, v}, {u, v + 2}, {u + 2, v + 2}, {u + 2, v}}});
    }
}

}  // namespace

void build_tunnels(const WorldContext& world) {
  for (const RoadTile& tile : world.roads.tiles(160.0)) {
    if (!tile.in_tunnel) continue;
    const road::RoadStructure& tunnel =
        *world.roads.structure_at(tile.road, tile.middle_m(), road::RoadStructure::Kind::tunnel);
    MeshBuilder tube, fittings, portal, cap;
    add_tube(tube, world, tile, true);
    add_tube(tube, world, tile, false);
    add_fittings(fittings, world, tile);
    geometry::PolygonMesh walls = tube.take();
    geometry::crease_by_angle(walls, 0.4f);
    add_tile_mesh(world, tile, "tube", walls, 0.0f, 1800.0f);
    add_tile_mesh(world, tile, "tunnel fittings", fittings.mesh(), 0.0f, 700.0f);
    for (const double outwards : {-1.0, 1.0}) {
      const double mouth = outwards < 0 ? tunnel.s_m : tunnel.s_m + tunnel.length_m;
      if (mouth < tile.s0_m - 0.01 || mouth > tile.s1_m + 0.01) continue;
      add_portal(portal, world, tile, mouth, outwards);
      add_cap(cap, world, tile, mouth, outwards);
    }
    geometry::PolygonMesh face = portal.take();
    face.default_edge_crease = geometry::crease_sharp;
    add_tile_mesh(world, tile, "portal", face, 0.0f, 4000.0f, true);
    add_tile_mesh(world, tile, "portal hill", cap.mesh(), 0.0f, 4000.0f, true);
  }
}

}  // namespace septet::scenery

#include <array>
#include <cmath>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/scenery/far_road.hpp"
#include "engine/scenery/world_context.hpp"
#include "engine/scenery/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using geometry::PathFrame;

struct Line {
  double s0_m, s1_m, t0_m, t1_m;
  double t_at(double s) const {
    return s1_m > s0_m ? std::lerp(t0_m, t1_m, (s - s0_m) / (s1_m - s0_m)) : t0_m;
  }
};

/// Frames along a line within a tile; right is −t, up is off the surface, the origin on the
/// surface.
std::vector<PathFrame> frames(const WorldContext& world, const RoadTile& tile, const Line& line,
                              double step_m) {
  std::vector<PathFrame> path;
  RoadTile part = tile;
  part.s0_m = std::max(tile.s0_m, line.s0_m);
  part.s1_m = std::min(tile.s1_m, line.s1_m);
  if (part.s1_m - part.s0_m < 0.5) return path;
  for (const double s : stations(part, step_m)) {
    const double t = line.t_at(s);
    const glm::vec3 p = world.roads.local(tile, s, t);
    const glm::vec3 left = world.roads.local(tile, s, t + 1.0) - p;
    path.push_back({p, -left, glm::vec3(0, 0, 1), static_cast<float>((s - tile.s0_m) / 4.0)});
  }
  return path;
}

void extrude_into(MeshBuilder& builder, Ground ground, std::span<const glm::vec2> profile,
                  const std::vector<PathFrame>& path, bool closed) {
  if (path.size() < 2) return;
  builder.material = index_of(ground);
  geometry::PolygonMesh mesh = geometry::extrude(profile, path, closed);
  const bool textured = ground == Ground::concrete || ground == Ground::noise_wall;
  for (auto& uvs : mesh.corner_uvs)
    for (glm::vec2& uv : uvs) uv = textured ? glm::vec2(uv.y, uv.x / 4.0f) : glm::vec2(0.0f);
  geometry::crease_by_angle(mesh, 0.5f);
  builder.append(mesh, glm::mat4(1.0f), true);
}

/// The steps of a New Jersey wall, seen along the road, counter-clockwise.
constexpr std::array<glm::vec2, 8> jersey{{{-0.30f, -0.05f},
                                           {0.30f, -0.05f},
                                           {0.30f, 0.08f},
                                           {0.14f, 0.34f},
                                           {0.09f, 0.90f},
                                           {-0.09f, 0.90f},
                                           {-0.14f, 0.34f},
                                           {-0.30f, 0.08f}}};
/// The W of a guard rail towards traffic at the left of the profile, folded round its back.
constexpr std::array<glm::vec2, 7> rail_left{{{-0.05f, 0.44f},
                                              {0.0f, 0.48f},
                                              {-0.08f, 0.53f},
                                              {-0.08f, 0.56f},
                                              {0.0f, 0.60f},
                                              {-0.08f, 0.66f},
                                              {-0.05f, 0.75f}}};
constexpr std::array<glm::vec2, 4> rail_simple{
    {{-0.04f, 0.44f}, {0.02f, 0.44f}, {0.02f, 0.75f}, {-0.04f, 0.75f}}};

/// A profile for the other side of the road, still counter-clockwise.
template <std::size_t N>
std::array<glm::vec2, N> mirrored(const std::array<glm::vec2, N>& profile) {
  std::array<glm::vec2, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = {-profile[N - 1 - i].x, profile[N - 1 - i].y};
  return result;
}

void add_posts(MeshBuilder& builder, const std::vector<PathFrame>& path, Ground ground,
               const glm::vec3& low, const glm::vec3& high) {
  builder.material = index_of(ground);
  geometry::PolygonMesh post = geometry::box(low, high);
  post.corner_uvs.clear();  // Plain materials need none.
  for (const PathFrame& frame : path) {
    glm::mat4 place(1.0f);
    const glm::vec3 forward = glm::cross(frame.up, frame.right);
    place[0] = glm::vec4(forward, 0);
    place[1] = glm::vec4(-frame.right, 0);
    place[2] = glm::vec4(frame.up, 0);
    place[3] = glm::vec4(frame.position_m, 1);
    builder.append(post, place, true);
  }
}

struct BarrierPen {
  const WorldContext& world;
  const RoadTile& tile;
  MeshBuilder near, posts;

  void draw(const road::RoadObject& object, const Line& line) {
    const bool left = line.t0_m > 0.0;
    const auto path = frames(world, tile, line, 10.0);
    if (object.subtype == "jerseyBarrier") {
      extrude_into(near, Ground::concrete, jersey, path, true);
    } else if (object.subtype == "railing") {
      draw_parapet(path);
    } else if (!tile.in_tunnel) {
      // Traffic is on the side of the axis.
      extrude_into(near, Ground::metal, left ? rail_left_sheet(false) : rail_left_sheet(true), path,
                   true);
      add_posts(posts, frames(world, tile, line, 4.0), Ground::metal_dark,
                {-0.05f, left ? 0.0f : -0.1f, -0.4f}, {0.05f, left ? 0.1f : 0.0f, 0.72f});
    }
  }

  /// The rail as a thin closed tube: the W in front, a flat back.
  static std::vector<glm::vec2> rail_left_sheet(bool on_right) {
    // For the left-hand side traffic is to the right (+x of the profile).
    const auto w = on_right ? rail_left : mirrored(rail_left);
    std::vector<glm::vec2> profile(w.begin(), w.end());
    if (on_right) {
      // Upwards along the front, which lies at the left: turned round, so that the tube is
      // counter-clockwise.
      profile = {w.rbegin(), w.rend()};
      profile.push_back({0.03f, 0.46f});
      profile.push_back({0.03f, 0.73f});
    } else {
      profile = {w.rbegin(), w.rend()};
      profile.push_back({-0.03f, 0.73f});
      profile.push_back({-0.03f, 0.46f});
    }
    return profile;
  }

  void draw_parapet(const std::vector<PathFrame>& path) {
    constexpr std::array<glm::vec2, 4> kerb{
        {{-0.16f, -0.1f}, {0.16f, -0.1f}, {0.16f, 0.35f}, {-0.16f, 0.35f}}};
    extrude_into(near, Ground::concrete, kerb, path, true);
    for (const float z : {0.62f, 0.90f, 1.16f}) {
      const std::array<glm::vec2, 4> bar{
          {{-0.03f, z}, {0.03f, z}, {0.03f, z + 0.06f}, {-0.03f, z + 0.06f}}};
      extrude_into(near, Ground::metal, bar, path, true);
    }
    add_posts(posts, path, Ground::metal, {-0.04f, -0.04f, 0.3f}, {0.04f, 0.04f, 1.2f});
  }
};

/// Reflecting posts every 50 m behind the rail, a kilometre board every 500 m.
void add_delineators(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile) {
  const road::Road& road = world.roads.road(tile.road);
  for (double s = std::ceil(tile.s0_m / 50.0) * 50.0; s < tile.s1_m; s += 50.0) {
    const road::RoadExtent extent = road::road_extent(road, s);
    for (const double side : {1.0, -1.0}) {
      const double t = (side > 0 ? extent.left_t_m : extent.right_t_m) + side * 1.2;
      const std::vector<PathFrame> path = frames(world, tile, {s - 0.5, s + 0.5, t, t}, 2.0);
      if (path.empty()) continue;
      const std::vector<PathFrame> one{path.front()};
      add_posts(builder, one, Ground::post, {-0.05f, -0.06f, -0.3f}, {0.05f, 0.06f, 1.05f});
      add_posts(builder, one, Ground::metal_dark, {-0.055f, -0.065f, 0.72f},
                {0.055f, 0.065f, 0.95f});
      add_posts(builder, one, Ground::reflector, {-0.06f, -0.03f, 0.76f}, {0.06f, 0.03f, 0.91f});
    }
  }
}

/// Stretches of wall between the motorway and the few houses.
void add_noise_wall(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile) {
  const road::Road& road = world.roads.road(tile.road);
  if (road.types.empty() || road.types.front().type != "motorway" || road.length_m < 2000.0) return;
  constexpr std::array<std::array<double, 3>, 3> walls{
      {{1900.0, 2450.0, 1.0}, {4500.0, 4900.0, -1.0}, {5350.0, 5750.0, 1.0}}};
  for (const auto& [from, to, side] : walls) {
    if (to > road.length_m) continue;
    const road::RoadExtent extent = road::road_extent(road, from);
    const double t = side > 0 ? extent.left_t_m + 2.6 : extent.right_t_m - 2.6;
    const auto path = frames(world, tile, {from, to, t, t}, 8.0);
    constexpr std::array<glm::vec2, 4> panel{
        {{-0.09f, -0.9f}, {0.09f, -0.9f}, {0.09f, 3.6f}, {-0.09f, 3.6f}}};
    extrude_into(builder, Ground::noise_wall, panel, path, true);
    add_posts(builder, path, Ground::metal_dark, {-0.1f, -0.16f, -0.9f}, {0.1f, 0.16f, 3.75f});
  }
}

/// Calls `visit` with every barrier of the tile's road and the line that it follows.
template <class Visit>
void for_each_barrier(const WorldContext& world, const RoadTile& tile, const Visit& visit) {
  const double length = world.roads.road(tile.road).length_m;
  for (const road::RoadObject& object : world.roads.road(tile.road).objects) {
    if (object.type != "barrier") continue;
    for (const road::ObjectRepeat& repeat : object.repeats) {
      Line line{repeat.s_m, repeat.s_m + repeat.length_m, repeat.t_start_m, repeat.t_end_m};
      // What runs to a loose end of the road runs on with it.
      if (line.s0_m < 0.01) line.s0_m = world.roads.begin_m(tile.road);
      if (line.s1_m > length - 0.01) line.s1_m = world.roads.end_m(tile.road);
      visit(object, line);
    }
  }
}

}  // namespace

void draw_far_barriers(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile,
                       double step_m) {
  for_each_barrier(world, tile, [&](const road::RoadObject& object, const Line& line) {
    const bool rail = object.subtype == "guardRail";
    if (rail && tile.in_tunnel) return;
    constexpr std::array<glm::vec2, 4> wall{
        {{-0.2f, -0.05f}, {0.2f, -0.05f}, {0.1f, 0.9f}, {-0.1f, 0.9f}}};
    extrude_into(builder, Ground::far_concrete, rail ? rail_simple : wall,
                 frames(world, tile, line, step_m), true);
  });
}

void build_barriers(const WorldContext& world) {
  for (const RoadTile& tile : world.roads.tiles(160.0)) {
    BarrierPen pen{world, tile, {}, {}};
    for_each_barrier(world, tile, [&](const road::RoadObject& object, const Line& line) {
      pen.draw(object, line);
    });
    if (!tile.in_tunnel && !tile.on_bridge) add_delineators(pen.posts, world, tile);
    MeshBuilder wall;
    add_noise_wall(wall, world, tile);
    add_tile_mesh(world, tile, "barriers", pen.near.mesh(), 0.0f, road_near_m, true);
    add_tile_mesh(world, tile, "posts", pen.posts.mesh(), 0.0f, 220.0f);
    add_tile_mesh(world, tile, "noise wall", wall.mesh(), 0.0f, 3000.0f, true);
  }
}

}  // namespace septet::scenery

#include <array>
#include <cmath>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/noise.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/roadside/barrier_lines.hpp"
#include "engine/roadside/obstacle_profile.hpp"
#include "engine/scenery/world/far_road.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using geometry::PathFrame;

using roadside::BarrierForm;
using roadside::BesideLine;

using roadside::Barrier;

/// Share by which a height must differ from the usual one to count.
constexpr double least_change = 0.03;
constexpr double usual_hedge_m = 0.8;  ///< Width of a hedge whose file gives none.
constexpr float leaf_tile_m = 1.2f;    ///< Length over which a hedge shows the texture of leaves once.
constexpr std::uint64_t hedge_seed = 17;
/// Unit of PathFrame::length_m in `frames`.
constexpr float frame_m = 4.0f;
constexpr float obstacle_top_m(ObstacleKind kind) { return static_cast<float>(roadside::profile_of(kind).height_m); }
constexpr float rail_top_m = obstacle_top_m(ObstacleKind::guard_rail),
                jersey_top_m = obstacle_top_m(ObstacleKind::concrete_barrier),
                parapet_top_m = obstacle_top_m(ObstacleKind::parapet),
                marker_top_m = obstacle_top_m(ObstacleKind::marker_post),
                noise_wall_top_m = obstacle_top_m(ObstacleKind::noise_wall);

float stretch(const Barrier& barrier, double s_m) {
  const double share = barrier.height_at(s_m) / roadside::usual_height_m(barrier.form);
  return std::abs(share - 1.0) < least_change ? 1.0f : static_cast<float>(share);
}

/// Frames along a line within a tile; right is −t, up is off the surface, the origin on the surface. `barrier`: its
/// height stretches up.
std::vector<PathFrame> frames(const WorldContext& world, const RoadTile& tile, const BesideLine& line, double step_m,
                              const Barrier* barrier = nullptr) {
  std::vector<PathFrame> path;
  for (const double s : roadside::stations(tile, line, step_m)) {
    const double t = line.t_at(s);
    const glm::vec3 p = world.roads.local(tile, s, t);
    const glm::vec3 left = world.roads.local(tile, s, t + 1.0) - p;
    path.push_back({p, -left, glm::vec3(0, 0, barrier ? stretch(*barrier, s) : 1.0f),
                    static_cast<float>((s - tile.s0_m) / frame_m)});
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

/// Profile of a New Jersey wall, seen along the road, counter-clockwise.
constexpr std::array<glm::vec2, 8> jersey{{{-0.30f, -0.05f},
                                           {0.30f, -0.05f},
                                           {0.30f, 0.08f},
                                           {0.14f, 0.34f},
                                           {0.09f, jersey_top_m},
                                           {-0.09f, jersey_top_m},
                                           {-0.14f, 0.34f},
                                           {-0.30f, 0.08f}}};
/// Profile of a guard rail's W towards traffic at its left, folded round its back.
constexpr std::array<glm::vec2, 7> rail_left{{{-0.05f, 0.44f},
                                              {0.0f, 0.48f},
                                              {-0.08f, 0.53f},
                                              {-0.08f, 0.56f},
                                              {0.0f, 0.60f},
                                              {-0.08f, 0.66f},
                                              {-0.05f, rail_top_m}}};
constexpr std::array<glm::vec2, 4> rail_simple{
    {{-0.04f, 0.44f}, {0.02f, 0.44f}, {0.02f, rail_top_m}, {-0.04f, rail_top_m}}};

/// Mirrors a profile for the other side of the road, still counter-clockwise.
template <std::size_t N>
std::array<glm::vec2, N> mirrored(const std::array<glm::vec2, N>& profile) {
  std::array<glm::vec2, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = {-profile[N - 1 - i].x, profile[N - 1 - i].y};
  return result;
}

void add_posts(MeshBuilder& builder, const std::vector<PathFrame>& path, Ground ground, const glm::vec3& low,
               const glm::vec3& high) {
  builder.material = index_of(ground);
  geometry::PolygonMesh post = geometry::box(low, high);
  post.corner_uvs.clear();  // Plain materials need no texture coordinates.
  for (const PathFrame& frame : path) {
    glm::mat4 place(1.0f);
    const glm::vec3 forward = glm::normalize(glm::cross(frame.up, frame.right));
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

  void draw(const roadside::Barrier& barrier) {
    const bool left = barrier.line.t0_m > 0.0;
    const auto path = frames(world, tile, barrier.line, roadside::barrier_step_m, &barrier);
    switch (barrier.form) {
      case BarrierForm::jersey:
        extrude_into(near, Ground::concrete, jersey, path, true);
        break;
      case BarrierForm::railing:
        draw_parapet(path);
        break;
      case BarrierForm::wall:
        extrude_into(near, Ground::concrete, box_of(barrier, 0.24), path, true);
        break;
      case BarrierForm::hedge:
        draw_hedge(barrier);
        break;
      case BarrierForm::fence:
        for (const float z : {0.35f, 0.85f, 1.35f}) {
          const std::array<glm::vec2, 4> bar{{{-0.02f, z}, {0.02f, z}, {0.02f, z + 0.12f}, {-0.02f, z + 0.12f}}};
          extrude_into(near, Ground::planks, bar, path, true);
        }
        add_posts(near, frames(world, tile, barrier.line, 2.5, &barrier), Ground::planks, {-0.05f, -0.05f, -0.3f},
                  {0.05f, 0.05f, 1.5f});
        break;
      case BarrierForm::rail:
        // Traffic is on the side of the axis.
        extrude_into(near, Ground::metal, rail_left_sheet(!left), path, true);
        add_posts(posts, frames(world, tile, barrier.line, 4.0, &barrier), Ground::metal_dark,
                  {-0.05f, left ? 0.0f : -0.1f, -0.4f}, {0.05f, left ? 0.1f : 0.0f, 0.72f});
        break;
    }
  }

  static std::array<glm::vec2, 4> box_of(const Barrier& barrier, double usual_width_m) {
    const auto half = static_cast<float>(0.5 * (barrier.width_m > 0.05 ? barrier.width_m : usual_width_m)),
               high = static_cast<float>(roadside::usual_height_m(barrier.form));
    return {{{-half, -0.3f}, {half, -0.3f}, {half, high}, {-half, high}}};
  }

  /// Draws leaves with holes, rounded at the top and uneven, over a dark core that hides the background, as crowns
  /// have.
  void draw_hedge(const roadside::Barrier& barrier) {
    const std::array<glm::vec2, 4> box = box_of(barrier, usual_hedge_m);
    const float half = box[2].x, high = box[2].y, foot = box[0].y;
    const std::array<glm::vec2, 8> shell{{{-half, foot},
                                          {half, foot},
                                          {half, 0.5f * high},
                                          {0.94f * half, 0.85f * high},
                                          {0.65f * half, high},
                                          {-0.65f * half, high},
                                          {-0.94f * half, 0.85f * high},
                                          {-half, 0.5f * high}}};
    const auto path = frames(world, tile, barrier.line, 1.25, &barrier);
    if (path.size() < 2) return;
    geometry::PolygonMesh leaves = geometry::extrude(shell, path, true);
    // Inwards only, so that width and height stay those of the file.
    const float unevenness_m = std::min(0.12f, 0.2f * half);
    const auto random = [](std::size_t n, std::int64_t axis) {
      return static_cast<float>(geometry::lattice_random(static_cast<std::int64_t>(n), axis, hedge_seed));
    };
    for (std::size_t n = 0; n < leaves.vertices_m.size(); ++n) {
      const PathFrame& frame = path[n / shell.size()];
      const glm::vec2 point = shell[n % shell.size()];
      if (point.y == foot) continue;
      leaves.vertices_m[n] -=
          unevenness_m * (std::copysign(random(n, 0), point.x) * frame.right + random(n, 1) * frame.up);
    }
    for (auto& uvs : leaves.corner_uvs)
      for (glm::vec2& uv : uvs) uv = glm::vec2(uv.y * frame_m, 2.0f * uv.x) / leaf_tile_m;
    near.material = index_of(Ground::leaves_oak);
    near.append(leaves, glm::mat4(1.0f), true);
    std::array<glm::vec2, 4> core = box;
    for (glm::vec2& corner : core) corner *= glm::vec2(0.65f, corner.y > 0.0f ? 0.75f : 1.0f);
    extrude_into(near, Ground::crown_core, core, frames(world, tile, barrier.line, roadside::barrier_step_m, &barrier),
                 true);
  }

  /// Guard rail as a thin closed tube: the W in front, a flat back.
  static std::vector<glm::vec2> rail_left_sheet(bool on_right) {
    // Traffic beside a left-hand rail is to the right (+x of the profile).
    const auto w = on_right ? rail_left : mirrored(rail_left);
    std::vector<glm::vec2> profile(w.begin(), w.end());
    if (on_right) {
      // Upwards along the front, which lies at the left: reversed, so that the tube is counter-clockwise.
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
    constexpr std::array<glm::vec2, 4> kerb{{{-0.16f, -0.1f}, {0.16f, -0.1f}, {0.16f, 0.35f}, {-0.16f, 0.35f}}};
    extrude_into(near, Ground::concrete, kerb, path, true);
    for (const float z : {0.62f, 0.90f, 1.16f}) {
      const std::array<glm::vec2, 4> bar{{{-0.03f, z}, {0.03f, z}, {0.03f, z + 0.06f}, {-0.03f, z + 0.06f}}};
      extrude_into(near, Ground::metal, bar, path, true);
    }
    add_posts(posts, path, Ground::metal, {-0.04f, -0.04f, 0.3f}, {0.04f, 0.04f, parapet_top_m});
  }
};

/// Adds reflecting posts every 50 m behind the rail, a kilometre board every 500 m.
void add_marker_posts(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile) {
  for (const BesideLine& line : roadside::marker_posts(world.roads, tile)) {
    const std::vector<PathFrame> path = frames(world, tile, line, roadside::marker_post_step_m);
    if (path.empty()) continue;
    const std::vector<PathFrame> one{path.front()};
    add_posts(builder, one, Ground::post, {-0.05f, -0.06f, -0.3f}, {0.05f, 0.06f, marker_top_m});
    add_posts(builder, one, Ground::metal_dark, {-0.055f, -0.065f, 0.72f}, {0.055f, 0.065f, 0.95f});
    add_posts(builder, one, Ground::reflector, {-0.06f, -0.03f, 0.76f}, {0.06f, 0.03f, 0.91f});
  }
}

void add_noise_wall(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile) {
  for (const BesideLine& line : roadside::noise_walls(world.roads, tile)) {
    const auto path = frames(world, tile, line, roadside::noise_wall_step_m);
    constexpr std::array<glm::vec2, 4> panel{
        {{-0.09f, -0.9f}, {0.09f, -0.9f}, {0.09f, noise_wall_top_m}, {-0.09f, noise_wall_top_m}}};
    extrude_into(builder, Ground::noise_wall, panel, path, true);
    add_posts(builder, path, Ground::metal_dark, {-0.1f, -0.16f, -0.9f}, {0.1f, 0.16f, noise_wall_top_m + 0.15f});
  }
}

}  // namespace

void draw_far_barriers(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double step_m) {
  for (const roadside::Barrier& barrier : roadside::barriers(world.roads, tile)) {
    constexpr std::array<glm::vec2, 4> wall{
        {{-0.2f, -0.05f}, {0.2f, -0.05f}, {0.1f, jersey_top_m}, {-0.1f, jersey_top_m}}};
    const bool high =
        barrier.form == BarrierForm::wall || barrier.form == BarrierForm::fence || barrier.form == BarrierForm::hedge;
    const auto profile = barrier.form == BarrierForm::rail ? rail_simple
                         : high                            ? BarrierPen::box_of(barrier, 0.3)
                                                           : wall;
    extrude_into(builder, barrier.form == BarrierForm::hedge ? Ground::crown_core : Ground::far_concrete, profile,
                 frames(world, tile, barrier.line, step_m, &barrier), true);
  }
}

void build_barriers(const WorldContext& world) {
  for (const RoadTile& tile : world.roads.tiles(160.0)) {
    BarrierPen pen{world, tile, {}, {}};
    for (const roadside::Barrier& barrier : roadside::barriers(world.roads, tile)) pen.draw(barrier);
    add_marker_posts(pen.posts, world, tile);
    MeshBuilder wall;
    add_noise_wall(wall, world, tile);
    add_tile_mesh(world, tile, "barriers", pen.near.mesh(), 0.0f, road_near_m, true);
    add_tile_mesh(world, tile, "posts", pen.posts.mesh(), 0.0f, 220.0f);
    add_tile_mesh(world, tile, "noise wall", wall.mesh(), 0.0f, 3000.0f, true);
  }
}

}  // namespace septet::scenery

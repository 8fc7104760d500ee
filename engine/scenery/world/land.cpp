#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/noise.hpp"
#include "engine/roadside/plants.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::lattice_random;
using geometry::MeshBuilder;

constexpr double tile_m = roadside::land_tile_m, middle_tile_m = roadside::middle_land_tile_m;
constexpr double near_cell_m = roadside::land_cell_m, middle_cell_m = roadside::middle_land_cell_m,
                 far_cell_m = roadside::far_land_cell_m;
constexpr float middle_until_m = 7000.0f;
constexpr double ring_drop_m = 0.35;  ///< Depth by which a tile's overlap of one cell over its neighbours is sunk.
constexpr double texture_m = 6.0;

/// Ground cover at a place: fields are the cells of a jittered lattice (a Voronoi diagram).
Ground field_at(const WorldContext& world, const Vec2& p) {
  constexpr double spacing = 210.0;
  const Vec2 q(p.x * 0.94 - p.y * 0.34, (p.x * 0.34 + p.y * 0.94) * 1.6);
  const auto cx = static_cast<std::int64_t>(std::floor(q.x / spacing)),
             cy = static_cast<std::int64_t>(std::floor(q.y / spacing));
  double best = 1e18, kind = 0.0;
  for (std::int64_t y = cy - 1; y <= cy + 1; ++y)
    for (std::int64_t x = cx - 1; x <= cx + 1; ++x) {
      const Vec2 seed_point((static_cast<double>(x) + lattice_random(x, y, world.seed + 5)) * spacing,
                            (static_cast<double>(y) + lattice_random(x, y, world.seed + 6)) * spacing);
      const double distance = glm::dot(q - seed_point, q - seed_point);
      if (distance < best) {
        best = distance;
        kind = lattice_random(x, y, world.seed + 7);
      }
    }
  if (kind < 0.30) return Ground::meadow;
  if (kind < 0.50) return Ground::pasture;
  if (kind < 0.68) return Ground::crop;
  if (kind < 0.82) return Ground::wheat;
  if (kind < 0.90) return Ground::rape;
  return Ground::soil;
}

/// Square grid of cells in a tile's frame. Its near form has one ring of cells more, whose outer edge is sunk, so that
/// neighbours meet without a crack and with the same normals.
class LandGrid {
 public:
  LandGrid(const WorldContext& world, const Vec2& corner, double side_m, double cell)
      : world_(world), corner_(corner), cell_(cell), count_(static_cast<int>(std::lround(side_m / cell))) {
    const Vec2 middle = corner + Vec2(side_m / 2);
    origin_ = Vec3(middle, world.terrain.height_m(middle));
    for (int y = -1; y <= count_ + 1; ++y)
      for (int x = -1; x <= count_ + 1; ++x) {
        const Vec2 p = corner_ + Vec2(x, y) * cell_;
        Point point{p, world.terrain.nearest(p), 0.0, Ground::verge};
        point.z = world.terrain.height_m(p, point.near);
        point.kind = kind_at(p, outside_m(point.near));
        points_.push_back(point);
      }
  }

  struct Point {
    Vec2 p;
    Nearest near;
    double z;
    Ground kind;  ///< Ground cover.
  };
  const Vec3& origin() const { return origin_; }
  const Point& at(int x, int y) const { return points_[static_cast<std::size_t>((y + 1) * (count_ + 3) + x + 1)]; }
  glm::vec3 local(int x, int y, double up = 0.0) const {
    const Point& point = at(x, y);
    return glm::vec3(Vec3(point.p, point.z + up) - origin_);
  }

  /// Draws the ground; true where land was left out for a tunnel's mouth.
  bool draw_ground(MeshBuilder& builder, bool plain) const {
    bool has_hole = false;
    const auto stride = static_cast<std::uint32_t>(count_ + 3);
    const auto first = static_cast<std::uint32_t>(builder.mesh().vertices_m.size());
    for (int y = -1; y <= count_ + 1; ++y)
      for (int x = -1; x <= count_ + 1; ++x) {
        const bool ring = x < 0 || y < 0 || x > count_ || y > count_;
        builder.vertex(local(x, y, ring ? -ring_drop_m : 0.0));
      }
    const int low = plain ? 0 : -1, high = plain ? count_ : count_ + 1;
    for (int y = low; y < high; ++y)
      for (int x = low; x < high; ++x) {
        const Vec2 middle = corner_ + (Vec2(x, y) + 0.5) * cell_;
        const Nearest near = world_.terrain.nearest(middle);
        if (world_.terrain.is_at_portal(near)) {
          has_hole = true;
          continue;
        }
        const std::uint32_t a = first + static_cast<std::uint32_t>(y + 1) * stride + static_cast<std::uint32_t>(x + 1);
        draw_cell(builder, x, y, {a, a + 1, a + stride + 1, a + stride}, plain);
      }
    return has_hole;
  }

  bool is_wood(int x, int y) const {
    const Vec2 middle = corner_ + (Vec2(x, y) + 0.5) * cell_;
    return roadside::is_wood(world_.terrain, middle, cell_);
  }

  /// Draws the crowns of a wood as one bumpy roof with sides.
  void draw_canopy(MeshBuilder& builder, bool plain) const {
    const bool plain_sides = cell_ > 100.0;
    std::map<std::pair<int, int>, std::uint32_t> tops;
    const auto top_point = [&](int x, int y, double share = 1.0) {
      const Vec2& p = at(x, y).p;
      return local(x, y, share * (10.5 + 5.5 * lattice_random(std::llround(p.x), std::llround(p.y), world_.seed + 8)));
    };
    const auto top = [&](int x, int y) {
      const auto [place, fresh] = tops.try_emplace({x, y}, 0u);
      // At the border the roof ends below the trees' tips, between which there are gaps.
      if (fresh) place->second = builder.vertex(top_point(x, y, !plain_sides && is_wood_border(x, y) ? 0.6 : 1.0));
      return place->second;
    };
    const auto length = static_cast<float>(cell_ / 55.0), d = static_cast<float>(std::round(cell_ / texture_m));
    for (int y = 0; y < count_; ++y)
      for (int x = 0; x < count_; ++x) {
        if (!is_wood(x, y)) continue;
        builder.material = index_of(plain ? Ground::far_canopy : Ground::canopy);
        builder.quad(top(x, y), top(x + 1, y), top(x + 1, y + 1), top(x, y + 1),
                     plain ? geometry::CornerUvs{} : geometry::CornerUvs{{{0, 0}, {d, 0}, {d, d}, {0, d}}});
        const auto side = [&](int nx, int ny, int ax, int ay, int bx, int by) {
          if (is_wood(nx, ny)) return;
          // Tips of the trees above the roof; from afar the side is part of it.
          const glm::vec3 tips(0, 0, plain_sides ? 0.0f : 2.5f);
          const auto start = static_cast<float>(lattice_random(x, y, 3));
          builder.material = index_of(plain_sides ? Ground::far_canopy : Ground::wood_edge);
          builder.patch(local(ax, ay, -0.5), local(bx, by, -0.5), top_point(bx, by) + tips, top_point(ax, ay) + tips,
                        plain_sides ? geometry::CornerUvs{}
                                    : geometry::CornerUvs{
                                          {{start, 1}, {start + length, 1}, {start + length, 0.02f}, {start, 0.02f}}});
        };
        side(x, y - 1, x, y, x + 1, y);
        side(x + 1, y, x + 1, y, x + 1, y + 1);
        side(x, y + 1, x + 1, y + 1, x, y + 1);
        side(x - 1, y, x, y + 1, x, y);
      }
  }

 private:
  static constexpr double verge_until_m = 34.0;
  /// Distance beyond a road, in a town beyond its yards.
  static double outside_m(const Nearest& near) {
    if (!near.found) return 1e9;
    return near.in_town ? std::max(0.0, near.outside_m - Nearest::yards_m + verge_until_m) : near.outside_m;
  }
  Ground kind_at(const Vec2& p, double outside_m) const {
    if (outside_m < verge_until_m) return Ground::verge;
    if (world_.terrain.woodland(p) > 0.5) return Ground::wood_floor;
    return field_at(world_, p);
  }

  /// Corner of a cell or place on its edge: position within the cell along x and y, and distance from the roads.
  struct Place {
    Vec2 p;
    double outside_m;
    glm::vec2 share;
    std::uint32_t vertex;
  };
  static Place between(const Place& a, const Place& b, double t) {
    return {glm::mix(a.p, b.p, t), std::lerp(a.outside_m, b.outside_m, t),
            glm::mix(a.share, b.share, static_cast<float>(t)), 0};
  }

  /// Place between two corners at which the ground changes, the same in either order of corners.
  Place change(MeshBuilder& builder, const Place& a, const Place& b) const {
    if (b.p.x < a.p.x || (b.p.x == a.p.x && b.p.y < a.p.y)) return change(builder, b, a);
    const Ground kind = kind_at(a.p, a.outside_m);
    double low = 0.0, high = 1.0;
    for (int round = 0; round < 5; ++round) {  // Precision of the transmitted positions.
      const double t = 0.5 * (low + high);
      const Place middle = between(a, b, t);
      (kind_at(middle.p, middle.outside_m) == kind ? low : high) = t;
    }
    Place place = between(a, b, 0.5 * (low + high));
    place.vertex = builder.vertex(glm::mix(builder.mesh().vertices_m[a.vertex], builder.mesh().vertices_m[b.vertex],
                                           static_cast<float>(0.5 * (low + high))));
    return place;
  }

  /// Draws one quad for a cell of one ground; where the border of two runs through it, both sides of a line along the
  /// border.
  void draw_cell(MeshBuilder& builder, int x, int y, const std::array<std::uint32_t, 4>& vertices, bool plain) const {
    std::array<Place, 4> corners;
    std::array<Ground, 4> kinds;
    constexpr std::array<std::array<int, 2>, 4> steps{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (std::size_t k = 0; k < 4; ++k) {
      const int i = x + steps[k][0], j = y + steps[k][1];
      const Point& point = at(i, j);
      corners[k] = {point.p, outside_m(point.near), {steps[k][0], steps[k][1]}, vertices[k]};
      kinds[k] = point.kind;
    }
    // Whole number of repeats per cell: neighbours meet, and the numbers are small on the wire.
    const auto d = static_cast<float>(std::round(cell_ / texture_m));
    const auto draw = [&](Ground kind, std::initializer_list<const Place*> places) {
      builder.material = index_of(plain ? far_of(kind) : kind);
      geometry::CornerUvs uvs{};
      std::array<std::uint32_t, 4> v{};
      std::size_t n = 0;
      for (const Place* place : places) {
        if (!plain) uvs[n] = place->share * d;
        v[n++] = place->vertex;
      }
      if (n == 4)
        builder.quad(v[0], v[1], v[2], v[3], uvs);
      else
        builder.triangle(v[0], v[1], v[2], uvs);
    };
    std::array<std::size_t, 4> changes{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k)
      if (kinds[k] != kinds[(k + 1) % 4]) changes[count++] = k;
    if (count != 2) {
      // Cells of one ground, or of more than two, take the ground of their middle.
      const Place middle = between(corners[0], corners[2], 0.5);
      draw(count == 0 ? kinds[0] : kind_at(middle.p, middle.outside_m),
           {&corners[0], &corners[1], &corners[2], &corners[3]});
      return;
    }
    // One side lies from the corner after the first change to the one before the second.
    const std::size_t first = (changes[0] + 1) % 4, last = changes[1];
    const std::size_t within = last - first + 1;
    const Place in = change(builder, corners[changes[0]], corners[first]),
                out = change(builder, corners[last], corners[(last + 1) % 4]);
    const auto corner = [&](std::size_t k) { return &corners[k % 4]; };
    const Ground inner = kinds[first], outer = kinds[(last + 1) % 4];
    if (within == 2) {
      draw(inner, {&in, corner(first), corner(first + 1), &out});
      draw(outer, {&out, corner(last + 1), corner(last + 2), &in});
      return;
    }
    // One corner lies alone: a triangle, and the other three with the border as a quad and a triangle.
    const bool alone_inside = within == 1;
    const std::size_t alone = alone_inside ? first : (last + 1) % 4;
    const Place &before = alone_inside ? in : out, &after = alone_inside ? out : in;
    draw(alone_inside ? inner : outer, {&before, corner(alone), &after});
    const Ground others = alone_inside ? outer : inner;
    draw(others, {&after, corner(alone + 1), corner(alone + 2), corner(alone + 3)});
    draw(others, {&after, corner(alone + 3), &before});
  }

  /// True if a corner of the grid lies at a wood's border.
  bool is_wood_border(int x, int y) const {
    return !(is_wood(x - 1, y - 1) && is_wood(x, y - 1) && is_wood(x - 1, y) && is_wood(x, y));
  }

  const WorldContext& world_;
  Vec2 corner_;
  double cell_;
  int count_;
  Vec3 origin_;
  std::vector<Point> points_;
};

void add_land_mesh(const WorldContext& world, const Vec3& origin, const char* name, const geometry::PolygonMesh& mesh,
                   float from, float to) {
  if (mesh.polygons.empty()) return;
  scene::MeshOptions options;
  options.position_step_m = 1.0 / 64.0;
  Placement placement;
  placement.parent_from_object.position_m = origin;
  placement.visible_from_m = from;
  placement.visible_to_m = to;
  placement.casts_shadow = false;
  place(world.builder, name, add_shape(world.builder, name, mesh, world.palette, options), placement);
}

/// Draws land and woods of a grid in plain colours as one mesh.
void build_plain(const WorldContext& world, const LandGrid& grid, const Vec3& origin, float from_m, float to_m) {
  MeshBuilder builder;
  grid.draw_ground(builder, true);
  grid.draw_canopy(builder, true);
  geometry::PolygonMesh mesh = builder.take();
  to_palette(mesh);
  const glm::vec3 shift(grid.origin() - origin);
  for (glm::vec3& p : mesh.vertices_m) p += shift;
  add_land_mesh(world, origin, "land far", mesh, from_m, to_m);
}

void build_tile(const WorldContext& world, const Vec2& corner) {
  if (world.terrain.distance_m(corner + Vec2(tile_m / 2)) > roadside::land_within_m) {
    const LandGrid grid(world, corner, tile_m, middle_cell_m);
    build_plain(world, grid, grid.origin(), 0.0f, middle_until_m);
    return;
  }
  const LandGrid near(world, corner, tile_m, near_cell_m);
  MeshBuilder ground, wood;
  const bool has_hole = near.draw_ground(ground, false);
  near.draw_canopy(wood, false);
  add_land_mesh(world, near.origin(), "land", ground.mesh(), 0.0f, land_near_m);
  add_land_mesh(world, near.origin(), "wood", wood.mesh(), 0.0f, land_near_m);
  // Large cells would reach across the road where the land breaks off at a portal.
  if (has_hole)
    build_plain(world, near, near.origin(), land_near_m, middle_until_m);
  else
    build_plain(world, LandGrid(world, corner, tile_m, middle_cell_m), near.origin(), land_near_m, middle_until_m);
}

void build_middle_tile(const WorldContext& world, const Vec2& corner) {
  if (world.terrain.distance_m(corner + Vec2(middle_tile_m / 2)) > roadside::middle_land_within_m) {
    const LandGrid grid(world, corner, middle_tile_m, middle_cell_m);
    build_plain(world, grid, grid.origin(), 0.0f, middle_until_m);
    return;
  }
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) build_tile(world, corner + Vec2(i, j) * tile_m);
}

/// Stream on a valley's floor. Along its banks and under the bridge it mirrors them, not the sky: there it is dark and
/// dull.
void build_water(const WorldContext& world, const Terrain::Valley& valley) {
  constexpr std::array<double, 4> columns_m{15.0, 11.0, -11.0, -15.0};
  constexpr double bridge_mirrored_m = 30.0;
  MeshBuilder builder;
  const Vec2 across(-valley.along.y, valley.along.x);
  std::uint32_t last = 0;
  for (double distance = -330.0; distance <= 330.0; distance += 15.0) {
    const Vec2 middle = Vec2(valley.middle_m) + across * distance + valley.along * Terrain::meander_m(distance);
    // Height over the bottom as the squares of the land draw it.
    const double z = world.terrain.height_m(middle) + 1.8;
    std::uint32_t row = 0;
    for (std::size_t k = 0; k < columns_m.size(); ++k) {
      const std::uint32_t v =
          builder.vertex(glm::vec3(Vec3(middle - valley.along * columns_m[k], z) - valley.middle_m));
      if (k == 0) row = v;
    }
    if (distance > -330.0)
      for (std::uint32_t k = 0; k + 1 < columns_m.size(); ++k) {
        const bool shaded = k != 1 || std::abs(distance - 7.5) < bridge_mirrored_m;
        builder.material = index_of(shaded ? Ground::water_shaded : Ground::water);
        builder.quad(last + k, last + k + 1, row + k + 1, row + k);
      }
    last = row;
  }
  add_land_mesh(world, valley.middle_m, "stream", builder.mesh(), 0.0f, 1500.0f);
}

}  // namespace

void build_land(const WorldContext& world) {
  constexpr double farthest_m = land_reach_m + land_tile_m / 2;
  for (const glm::i64vec2& square : world.terrain.squares_near(land_tile_m, farthest_m)) {
    const Vec2 corner = Vec2(square) * land_tile_m;
    const double distance = world.terrain.distance_m(corner + Vec2(land_tile_m / 2));
    if (distance > farthest_m) continue;
    if (distance > roadside::far_land_from_m) {
      const LandGrid grid(world, corner, land_tile_m, far_cell_m);
      build_plain(world, grid, grid.origin(), 0.0f, all_m);
      continue;
    }
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) build_middle_tile(world, corner + Vec2(i, j) * middle_tile_m);
  }
  for (const Terrain::Valley& valley : world.terrain.valleys()) build_water(world, valley);
}

}  // namespace septet::scenery

#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/random.hpp"
#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/world_context.hpp"
#include "engine/scenery/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

struct HouseSize {
  float length, width, eaves, ridge;
  Ground wall, roof;
};

/// Walls with one window every four metres, a saddle roof with eaves, its chimney.
void add_house(MeshBuilder& builder, const HouseSize& s, float x0, float y0) {
  const float l = s.length / 2, w = s.width / 2, foot = -1.5f;
  const auto at = [&](float x, float y, float z) { return glm::vec3(x0 + x, y0 + y, z); };
  const float nu = std::round(s.length / 4), nw = std::round(s.width / 4),
              nv = std::round(s.eaves / 2.8f), low = 1.5f / 2.8f;
  builder.material = index_of(s.wall);
  const auto wall = [&](const glm::vec3& a, const glm::vec3& b, float windows) {
    builder.patch(a + glm::vec3(0, 0, foot), b + glm::vec3(0, 0, foot),
                  b + glm::vec3(0, 0, s.eaves), a + glm::vec3(0, 0, s.eaves),
                  {{{0, nv + low}, {windows, nv + low}, {windows, 0}, {0, 0}}});
  };
  wall(at(-l, -w, 0), at(l, -w, 0), nu);
  wall(at(l, -w, 0), at(l, w, 0), nw);
  wall(at(l, w, 0), at(-l, w, 0), nu);
  wall(at(-l, w, 0), at(-l, -w, 0), nw);
  for (const float side : {1.0f, -1.0f}) {
    const std::uint32_t a = builder.vertex(at(side * l, -side * w, s.eaves)),
                        b = builder.vertex(at(side * l, side * w, s.eaves)),
                        c = builder.vertex(at(side * l, 0, s.ridge));
    builder.triangle(a, b, c, {{{0, 0.22f}, {0.2f, 0.22f}, {0.1f, 0.02f}, {}}});
  }
  builder.material = index_of(s.roof);
  const float over = 0.5f, drop = over * (s.ridge - s.eaves) / w;
  builder.patch(at(-l - over, -w - over, s.eaves - drop), at(l + over, -w - over, s.eaves - drop),
                at(l + over, 0, s.ridge + 0.08f), at(-l - over, 0, s.ridge + 0.08f));
  builder.patch(at(l + over, w + over, s.eaves - drop), at(-l - over, w + over, s.eaves - drop),
                at(-l - over, 0, s.ridge + 0.08f), at(l + over, 0, s.ridge + 0.08f));
  builder.append(geometry::box(at(-0.4f + l * 0.3f, -0.4f, s.ridge - 0.6f),
                               at(0.4f + l * 0.3f, 0.4f, s.ridge + 0.9f)),
                 glm::mat4(1.0f), true);
}

geometry::PolygonMesh farm(bool red) {
  MeshBuilder builder;
  add_house(
      builder,
      {12, 8, 5.4f, 8.6f, red ? Ground::facade_red : Ground::facade_white, Ground::roof_tiles}, 0,
      0);
  add_house(builder, {26, 11, 4.8f, 10.0f, Ground::planks, Ground::roof_dark}, 26, 18);
  add_house(builder, {9, 6, 2.7f, 4.8f, Ground::facade_red, Ground::roof_tiles}, -16, 14);
  return builder.take();
}

geometry::PolygonMesh church() {
  MeshBuilder builder;
  add_house(builder, {22, 10, 7.5f, 13.0f, Ground::facade_white, Ground::roof_dark}, 0, 0);
  builder.material = index_of(Ground::facade_white);
  builder.append(geometry::box({-16.0f, -3.2f, -1.5f}, {-9.6f, 3.2f, 19.0f}), glm::mat4(1.0f),
                 true);
  builder.material = index_of(Ground::roof_dark);
  const std::array<geometry::LathePoint, 3> spire{{{5.0f, 19.0f}, {1.6f, 24.0f}, {0.0f, 36.0f}}};
  glm::mat4 to(1.0f);
  to[3] = glm::vec4(-12.8f, 0, 0, 1);
  builder.append(geometry::lathe(spire, 4), to, true);
  return builder.take();
}

}  // namespace

void build_buildings(const WorldContext& world) {
  std::array<geometry::PolygonMesh, 3> meshes{farm(true), farm(false), church()};
  std::array<Shape, 3> shapes;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    meshes[i].default_edge_crease = geometry::crease_sharp;
    shapes[i] = add_shape(world.builder, i < 2 ? "farm" : "church", meshes[i], world.palette);
  }
  Random random(world.seed, 3);
  int since_church = 4;
  for (road::RoadIndex index = 0; index < world.roads.network().roads.size(); ++index)
    for (double s = world.roads.begin_m(index) + 150.0; s < world.roads.end_m(index);
         s += random.uniform(260.0, 620.0)) {
      const double side = random.uniform() < 0.5 ? 1.0 : -1.0,
                   t = side * random.uniform(120.0, 420.0),
                   turn = random.uniform(0, 2 * std::numbers::pi);
      const Vec2 p(world.roads.point(index, s, t));
      const Nearest near = world.terrain.nearest(p);
      if (!near.found || near.outside_m < 75.0 || world.terrain.woodland(p) > 0.02) continue;
      const double z = world.terrain.height_m(p, near);
      // Not on a slope.
      if (std::abs(world.terrain.height_m(p + Vec2(25, 0)) - z) +
              std::abs(world.terrain.height_m(p + Vec2(0, 25)) - z) >
          4.5)
        continue;
      const bool is_church = ++since_church > 8;
      if (is_church) since_church = 0;
      Placement placement;
      placement.parent_from_object = {Vec3(p, z), glm::angleAxis(turn, Vec3(0, 0, 1))};
      placement.visible_to_m = 3500.0f;
      place(world.builder, "building", shapes[is_church ? 2 : random.below(2)], placement);
    }
}

}  // namespace septet::scenery

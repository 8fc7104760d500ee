#include <array>
#include <cmath>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/roadside/buildings.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

using roadside::BuildingKind;

struct HouseLook {
  float eaves, ridge;
  Ground wall, roof;
};

/// Walls with one window every four metres, a saddle roof with eaves, its chimney.
void add_house(MeshBuilder& builder, const roadside::HouseBlock& block, const HouseLook& s) {
  const auto length = static_cast<float>(block.length_m), width = static_cast<float>(block.width_m),
             x0 = static_cast<float>(block.x_m), y0 = static_cast<float>(block.y_m);
  const float l = length / 2, w = width / 2, foot = -1.5f;
  const auto at = [&](float x, float y, float z) { return glm::vec3(x0 + x, y0 + y, z); };
  const float nu = std::round(length / 4), nw = std::round(width / 4), nv = std::round(s.eaves / 2.8f),
              low = 1.5f / 2.8f;
  builder.material = index_of(s.wall);
  const auto wall = [&](const glm::vec3& a, const glm::vec3& b, float windows) {
    builder.patch(a + glm::vec3(0, 0, foot), b + glm::vec3(0, 0, foot), b + glm::vec3(0, 0, s.eaves),
                  a + glm::vec3(0, 0, s.eaves), {{{0, nv + low}, {windows, nv + low}, {windows, 0}, {0, 0}}});
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
  builder.append(geometry::box(at(-0.4f + l * 0.3f, -0.4f, s.ridge - 0.6f), at(0.4f + l * 0.3f, 0.4f, s.ridge + 0.9f)),
                 glm::mat4(1.0f), true);
}

geometry::PolygonMesh farm(bool red) {
  MeshBuilder builder;
  const std::array<HouseLook, 3> looks{
      {{5.4f, 8.6f, red ? Ground::facade_red : Ground::facade_white, Ground::roof_tiles},
       {4.8f, 10.0f, Ground::planks, Ground::roof_dark},
       {2.7f, 4.8f, Ground::facade_red, Ground::roof_tiles}}};
  const auto blocks = roadside::house_blocks(BuildingKind::red_farm);
  for (std::size_t i = 0; i < looks.size(); ++i) add_house(builder, blocks[i], looks[i]);
  return builder.take();
}

geometry::PolygonMesh church() {
  MeshBuilder builder;
  const auto blocks = roadside::house_blocks(BuildingKind::church);
  add_house(builder, blocks[0], {7.5f, 13.0f, Ground::facade_white, Ground::roof_dark});
  const auto& tower = blocks[1];
  const glm::vec2 middle(tower.x_m, tower.y_m), half(tower.length_m / 2, tower.width_m / 2);
  builder.material = index_of(Ground::facade_white);
  builder.append(geometry::box(glm::vec3(middle - half, -1.5f), glm::vec3(middle + half, 19.0f)), glm::mat4(1.0f),
                 true);
  builder.material = index_of(Ground::roof_dark);
  const std::array<geometry::LathePoint, 3> spire{{{5.0f, 19.0f}, {1.6f, 24.0f}, {0.0f, 36.0f}}};
  glm::mat4 to(1.0f);
  to[3] = glm::vec4(middle, 0, 1);
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
  for (const roadside::Building& building : roadside::placed_buildings(world.roads, world.terrain, world.seed)) {
    Placement placement;
    placement.parent_from_object = building.world_from_building;
    placement.visible_to_m = 3500.0f;
    place(world.builder, "building", shapes[static_cast<std::size_t>(building.kind)], placement);
  }
}

}  // namespace septet::scenery

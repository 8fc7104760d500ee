#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/roadside/buildings.hpp"
#include "engine/scenery/world/house_shape.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

using roadside::BuildingKind;

geometry::PolygonMesh farm(bool red) {
  MeshBuilder builder;
  const std::array<HouseLook, 3> looks{{{5.4f, 8.6f, red ? Ground::farm_red : Ground::farm_white, Ground::roof_tiles},
                                        {4.8f, 10.0f, Ground::planks, Ground::roof_dark},
                                        {2.7f, 4.8f, Ground::farm_red, Ground::roof_tiles}}};
  const auto blocks = roadside::house_blocks(BuildingKind::red_farm);
  for (std::size_t i = 0; i < looks.size(); ++i) add_house(builder, blocks[i], looks[i]);
  return builder.take();
}

geometry::PolygonMesh church() {
  MeshBuilder builder;
  const auto blocks = roadside::house_blocks(BuildingKind::church);
  add_house(builder, blocks[0], {7.5f, 13.0f, Ground::farm_white, Ground::roof_dark});
  const auto& tower = blocks[1];
  const glm::vec2 middle(tower.x_m, tower.y_m), half(tower.length_m / 2, tower.width_m / 2);
  builder.material = index_of(Ground::farm_white);
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
    constexpr std::array<std::string_view, roadside::building_kind_count> names{"red-farm", "white-farm", "church"};
    const auto kind = static_cast<std::size_t>(building.kind);
    if (!world.own.place(names[kind], placement)) place(world.builder, "building", shapes[kind], placement);
  }
}

}  // namespace septet::scenery

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "engine/core/random.hpp"
#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/roadside/street.hpp"
#include "engine/scenery/world/house_shape.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"
#include "engine/world/street_lamp.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using roadside::TownHouseKind;

constexpr std::array<Ground, roadside::town_house_colour_count> plaster{Ground::facade_white, Ground::facade_yellow,
                                                                        Ground::facade_red, Ground::facade_grey};

HouseLook look_of(TownHouseKind kind, std::size_t colour) {
  constexpr std::array<std::array<float, 2>, roadside::town_house_kind_count> heights{
      {{3.0f, 6.2f}, {5.7f, 9.0f}, {8.6f, 12.0f}}};
  const auto& [eaves, ridge] = heights[static_cast<std::size_t>(kind)];
  return {eaves, ridge, plaster[colour], colour % 2 == 0 ? Ground::roof_tiles : Ground::roof_dark};
}

geometry::PolygonMesh town_house(TownHouseKind kind, std::size_t colour) {
  const roadside::TownHouseSize size = roadside::size_of(kind);
  MeshBuilder builder;
  add_house(builder, {size.length_m, size.depth_m, 0.0, 0.0}, look_of(kind, colour));
  // Door towards the street, on a step.
  const auto front = static_cast<float>(-0.5 * size.depth_m);
  builder.material = index_of(Ground::roof_dark);
  builder.append(geometry::box({-0.5f, front - 0.06f, -0.2f}, {0.5f, front + 0.02f, 2.1f}), glm::mat4(1.0f), true);
  builder.material = index_of(Ground::kerb_stone);
  builder.append(geometry::box({-0.8f, front - 1.0f, -0.4f}, {0.8f, front, 0.12f}), glm::mat4(1.0f), true);
  geometry::PolygonMesh mesh = builder.take();
  mesh.default_edge_crease = geometry::crease_sharp;
  return mesh;
}

/// Number of choices of a house's lit windows, of which each house has one.
constexpr std::size_t lit_choices = 3;
constexpr double share_of_lit_windows = 0.3;

geometry::PolygonMesh lit_windows(TownHouseKind kind, std::size_t choice, std::uint64_t seed) {
  const roadside::TownHouseSize size = roadside::size_of(kind);
  Random random(seed, 7000 + static_cast<std::uint64_t>(kind) * lit_choices + choice);
  MeshBuilder builder;
  add_lit_windows(builder, {size.length_m, size.depth_m, 0.0, 0.0}, look_of(kind, 0), share_of_lit_windows, random);
  geometry::PolygonMesh mesh = builder.take();
  mesh.default_edge_crease = geometry::crease_sharp;
  return mesh;
}

/// Pole, its arm over the road, and a flat head whose lens faces down.
geometry::PolygonMesh lamp() {
  constexpr auto height = static_cast<float>(street_lamp::height_m), arm = static_cast<float>(street_lamp::arm_m);
  MeshBuilder builder;
  builder.material = index_of(Ground::metal);
  builder.append(geometry::cylinder(0.07f, -0.4f, height, 8), glm::mat4(1.0f), true);
  builder.append(geometry::box({0.0f, -0.04f, height - 0.08f}, {arm, 0.04f, height}), glm::mat4(1.0f), true);
  builder.material = index_of(Ground::metal_dark);
  builder.append(geometry::box({arm - 0.325f, -0.14f, height - 0.06f}, {arm + 0.325f, 0.14f, height + 0.06f}),
                 glm::mat4(1.0f), true);
  builder.material = index_of(Ground::lamp_street);
  const float z = height - 0.075f;
  builder.patch({arm - 0.275f, 0.11f, z}, {arm + 0.275f, 0.11f, z}, {arm + 0.275f, -0.11f, z},
                {arm - 0.275f, -0.11f, z});
  geometry::PolygonMesh mesh = builder.take();
  mesh.default_edge_crease = geometry::crease_sharp;
  return mesh;
}

}  // namespace

void build_streets(const WorldContext& world) {
  std::array<std::array<Shape, roadside::town_house_colour_count>, roadside::town_house_kind_count> shapes;
  std::array<std::array<Shape, lit_choices>, roadside::town_house_kind_count> lit;
  Random choices(world.seed, 6999);
  for (const roadside::TownHouse& house : roadside::town_houses(world.roads, world.seed)) {
    Placement placement;
    placement.parent_from_object = house.world_from_house;
    placement.visible_to_m = 2500.0f;
    constexpr std::array<std::string_view, roadside::town_house_kind_count> names{"cottage", "town-house",
                                                                                  "town-block"};
    if (world.own.place(names[static_cast<std::size_t>(house.kind)], placement)) continue;
    const auto colour = static_cast<std::size_t>(house.colour);
    Shape& shape = shapes[static_cast<std::size_t>(house.kind)][colour];
    if (shape.geometry == scene::no_node)
      shape = add_shape(world.builder, "town house", town_house(house.kind, colour), world.palette);
    const scene::NodeId standing = place(world.builder, "town house", shape, placement);
    const std::size_t choice = choices.below(lit_choices);
    Shape& windows = lit[static_cast<std::size_t>(house.kind)][choice];
    if (windows.geometry == scene::no_node)
      windows = add_shape(world.builder, "lit windows", lit_windows(house.kind, choice, world.seed), world.palette);
    placement.parent_from_object = {};
    placement.visible_to_m = 900.0f;
    placement.casts_shadow = false;
    place(world.builder, "lit windows", windows, placement, standing);
  }
  Shape lamp_shape;
  for (const roadside::StreetLamp& street_lamp : roadside::street_lamps(world.roads)) {
    Placement placement;
    placement.parent_from_object = street_lamp.world_from_lamp;
    placement.visible_to_m = 450.0f;
    if (world.own.place("street-lamp", placement)) continue;
    if (lamp_shape.geometry == scene::no_node)
      lamp_shape = add_shape(world.builder, "street lamp", lamp(), world.palette);
    place(world.builder, "street lamp", lamp_shape, placement);
  }
}

}  // namespace septet::scenery

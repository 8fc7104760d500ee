#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/roadside/street_furniture.hpp"
#include "engine/scenery/world/ground_box.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using roadside::FurnitureKind;

void add_post(MeshBuilder& builder, Ground ground, float radius, float low, float high, std::uint32_t sides = 10) {
  builder.material = index_of(ground);
  builder.append(geometry::cylinder(radius, low, high, sides), glm::mat4(1.0f), true);
}

void add_bench(MeshBuilder& builder) {
  for (const float x : {-0.7f, 0.7f})
    add_box(builder, Ground::metal_dark, {x - 0.03f, -0.2f, 0.0f}, {x + 0.03f, 0.2f, 0.44f});
  for (const float y : {-0.2f, -0.06f, 0.08f})
    add_box(builder, Ground::door, {-0.9f, y, 0.44f}, {0.9f, y + 0.11f, 0.48f});
  for (const float z : {0.58f, 0.74f}) add_box(builder, Ground::door, {-0.9f, 0.2f, z}, {0.9f, 0.24f, z + 0.11f});
}

void add_cycle_stands(MeshBuilder& builder) {
  for (float x = -1.6f; x < 2.0f; x += 0.8f) {
    for (const float y : {-0.05f, 0.65f})
      add_box(builder, Ground::metal, {x - 0.025f, y, 0.0f}, {x + 0.025f, y + 0.05f, 0.8f});
    add_box(builder, Ground::metal, {x - 0.025f, -0.05f, 0.76f}, {x + 0.025f, 0.7f, 0.81f});
  }
}

geometry::PolygonMesh shape_of(FurnitureKind kind) {
  MeshBuilder builder;
  switch (kind) {
    case FurnitureKind::bin:
      add_post(builder, Ground::metal_dark, 0.04f, 0.0f, 1.1f, 6);
      add_box(builder, Ground::awning_green, {-0.2f, -0.16f, 0.45f}, {0.2f, 0.16f, 1.0f});
      break;
    case FurnitureKind::bench:
      add_bench(builder);
      break;
    case FurnitureKind::letter_box:
      add_post(builder, Ground::metal_dark, 0.05f, 0.0f, 0.8f, 6);
      add_box(builder, Ground::awning_red, {-0.28f, -0.2f, 0.75f}, {0.28f, 0.2f, 1.5f});
      break;
    case FurnitureKind::cabinet:
      add_box(builder, Ground::metal, {-0.55f, -0.18f, 0.0f}, {0.55f, 0.18f, 1.25f});
      add_box(builder, Ground::metal_dark, {-0.58f, -0.2f, 1.25f}, {0.58f, 0.2f, 1.3f});
      break;
    case FurnitureKind::advertising_column:
      add_post(builder, Ground::concrete, 0.55f, 0.0f, 2.7f, 16);
      add_post(builder, Ground::metal_dark, 0.66f, 2.7f, 2.95f, 16);
      break;
    case FurnitureKind::cycle_stands:
      add_cycle_stands(builder);
      break;
    case FurnitureKind::planter:
      add_box(builder, Ground::concrete, {-0.7f, -0.35f, 0.0f}, {0.7f, 0.35f, 0.5f});
      add_box(builder, Ground::leaves_oak, {-0.62f, -0.28f, 0.5f}, {0.62f, 0.28f, 0.85f});
      break;
    case FurnitureKind::bollard:
      add_post(builder, Ground::post, 0.06f, 0.0f, 0.9f, 8);
      add_post(builder, Ground::awning_red, 0.065f, 0.7f, 0.8f, 8);
      break;
    case FurnitureKind::gully:
      add_box(builder, Ground::metal_dark, {-0.25f, -0.2f, -0.05f}, {0.25f, 0.2f, 0.008f});
      break;
    case FurnitureKind::manhole:
      add_post(builder, Ground::metal_dark, 0.32f, -0.05f, 0.008f, 16);
      break;
  }
  geometry::PolygonMesh mesh = builder.take();
  mesh.default_edge_crease = geometry::crease_sharp;
  return mesh;
}

}  // namespace

void build_furniture(const WorldContext& world) {
  constexpr float seen_to_m = 160.0f, lid_seen_to_m = 60.0f;
  std::array<Shape, roadside::furniture_kind_count> shapes;
  for (const roadside::Furniture& thing : roadside::street_furniture(world.roads, world.seed)) {
    Shape& shape = shapes[static_cast<std::size_t>(thing.kind)];
    if (shape.geometry == scene::no_node)
      shape = add_shape(world.builder, "street furniture", shape_of(thing.kind), world.palette);
    const bool is_lid = roadside::radius_of(thing.kind) <= 0.0;
    Placement placement;
    placement.parent_from_object = thing.world_from_thing;
    placement.visible_to_m = is_lid ? lid_seen_to_m : seen_to_m;
    placement.casts_shadow = !is_lid;
    place(world.builder, "street furniture", shape, placement);
  }
}

}  // namespace septet::scenery

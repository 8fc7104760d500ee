#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/roadside/standing_objects.hpp"
#include "engine/scenery/world/house_shape.hpp"
#include "engine/scenery/world/town_building.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using roadside::StandingKind;
using roadside::StandingObject;

constexpr std::array<Ground, 4> object_walls{Ground::facade_white, Ground::facade_yellow, Ground::facade_red,
                                             Ground::facade_grey};

bool is_rectangle(std::span<const Vec2> corners) {
  return corners.size() == 4 && glm::length(corners[0] + corners[2] - corners[1] - corners[3]) < 0.05 &&
         std::abs(glm::dot(corners[1] - corners[0], corners[3] - corners[0])) < 0.05;
}

/// Adds walls along the footprint, with a window every four metres where it is a building, and a flat roof.
void add_prism(MeshBuilder& builder, const StandingObject& object, Ground wall, Ground roof) {
  const auto height = static_cast<float>(object.height_m), foot = object.kind == StandingKind::building ? -1.5f : -0.2f;
  const std::size_t count = object.footprint_m.size();
  const auto at = [&](std::size_t i, float z) { return glm::vec3(glm::vec2(object.footprint_m[i % count]), z); };
  builder.material = index_of(wall);
  const float storeys = std::max(1.0f, std::round(height / 2.8f)), low = 1.5f / 2.8f;
  for (std::size_t i = 0; i < count; ++i) {
    const float windows =
        std::round(static_cast<float>(glm::length(object.footprint_m[(i + 1) % count] - object.footprint_m[i])) / 4.0f);
    builder.patch(at(i, foot), at(i + 1, foot), at(i + 1, height), at(i, height),
                  {{{0, storeys + low}, {windows, storeys + low}, {windows, 0}, {0, 0}}});
  }
  builder.material = index_of(roof);
  // Fan from the middle: exact for convex outlines, and an approximation for the rest.
  Vec2 middle(0.0);
  for (const Vec2& corner : object.footprint_m) middle += corner / static_cast<double>(count);
  const std::uint32_t top = builder.vertex(glm::vec3(glm::vec2(middle), height));
  std::vector<std::uint32_t> rim;
  for (std::size_t i = 0; i < count; ++i) rim.push_back(builder.vertex(at(i, height)));
  for (std::size_t i = 0; i < count; ++i) builder.triangle(top, rim[i], rim[(i + 1) % count], {});
}

geometry::PolygonMesh object_shape(const StandingObject& object, std::size_t number) {
  MeshBuilder builder;
  constexpr double highest_saddle_m = 11.0, widest_saddle_m = 16.0;
  const std::vector<Vec2>& foot = object.footprint_m;
  if (object.kind == StandingKind::block) {
    add_prism(builder, object, Ground::concrete, Ground::concrete);
  } else if (is_rectangle(foot) && object.height_m < highest_saddle_m) {
    const Vec2 along = foot[1] - foot[0], aside = foot[3] - foot[0];
    const bool long_way = glm::length(along) >= glm::length(aside);
    const double length_m = glm::length(long_way ? along : aside), width_m = glm::length(long_way ? aside : along);
    if (width_m < widest_saddle_m && width_m > 2.0 && std::abs(long_way ? along.y : along.x) < 0.05) {
      const Vec2 middle = 0.5 * (foot[0] + foot[2]);
      const auto height = static_cast<float>(object.height_m);
      MeshBuilder house;
      add_house(house, {length_m, width_m, 0.0, 0.0},
                {std::max(2.2f, 0.68f * height), height, object_walls[number % object_walls.size()],
                 number % 2 == 0 ? Ground::roof_tiles : Ground::roof_dark});
      glm::mat4 turn(1.0f);
      if (!long_way)
        turn = glm::mat4(glm::vec4(0, 1, 0, 0), glm::vec4(-1, 0, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, 0, 0, 1));
      turn[3] = glm::vec4(glm::vec2(middle), 0.0f, 1.0f);
      builder.append(house.mesh(), turn);
    } else {
      add_prism(builder, object, object_walls[number % object_walls.size()], Ground::roof_dark);
    }
  } else {
    add_prism(builder, object, object_walls[number % object_walls.size()], Ground::roof_dark);
  }
  geometry::PolygonMesh mesh = builder.take();
  mesh.default_edge_crease = geometry::crease_sharp;
  return mesh;
}

/// The building that a subtype names, if its outline is a rectangle along the object's axes.
std::optional<TownBuilding> town_building_of(const StandingObject& object, std::size_t number) {
  const std::vector<Vec2>& foot = object.footprint_m;
  if (object.use == roadside::BuildingUse::unknown || !is_rectangle(foot) || std::abs(foot[1].y - foot[0].y) > 0.05 ||
      glm::length(foot[0] + foot[2]) > 0.05)
    return std::nullopt;
  return TownBuilding{object.use, glm::length(foot[1] - foot[0]), glm::length(foot[3] - foot[0]), object.height_m,
                      number % town_walls};
}

/// Buildings of equal shape share it.
class TownPen {
 public:
  explicit TownPen(const WorldContext& world) : world_(world), choices_(world.seed, 6998) {}

  void draw(const TownBuilding& building, Placement placement) {
    Shape& shape = shapes_[building];
    if (shape.geometry == scene::no_node)
      shape = add_shape(world_.builder, "town building", town_building(building), world_.palette);
    placement.visible_to_m = 2500.0f;
    const scene::NodeId standing = place(world_.builder, "town building", shape, placement);
    if (building.use == roadside::BuildingUse::tower || building.use == roadside::BuildingUse::church) return;
    TownBuilding lit = building;
    lit.variant = choices_.below(lit_choices);
    Shape& windows = lit_[lit];
    if (windows.geometry == scene::no_node)
      windows = add_shape(world_.builder, "lit windows", lit_windows(lit), world_.palette);
    // A child: one name moves and hides the building.
    placement.parent_from_object = {};
    placement.visible_to_m = 900.0f;
    placement.casts_shadow = false;
    place(world_.builder, "lit windows", windows, placement, standing);
  }

 private:
  geometry::PolygonMesh lit_windows(const TownBuilding& building) const {
    constexpr double share = 0.3;
    Random random(world_.seed, 7100 + building.variant);
    MeshBuilder builder;
    add_lit_windows(builder, {building.length_m, building.width_m, 0.0, 0.0}, look_of(building), share, random);
    geometry::PolygonMesh mesh = builder.take();
    mesh.default_edge_crease = geometry::crease_sharp;
    return mesh;
  }

  static constexpr std::size_t lit_choices = 3;
  const WorldContext& world_;
  Random choices_;
  std::map<TownBuilding, Shape> shapes_, lit_;
};

}  // namespace

void build_objects(const WorldContext& world) {
  TownPen town(world);
  Shape pole;
  std::size_t number = 0;
  for (const StandingObject& object : roadside::standing_objects(world.roads)) {
    Placement placement;
    placement.parent_from_object = object.world_from_object;
    if (object.kind == StandingKind::pole) {
      if (pole.geometry == scene::no_node) {
        MeshBuilder builder;
        builder.material = index_of(Ground::metal);
        builder.append(geometry::cylinder(1.0f, -0.05f, 1.0f, 10), glm::mat4(1.0f), true);
        pole = add_shape(world.builder, "pole", builder.take(), world.palette);
      }
      const auto radius = static_cast<float>(object.radius_m);
      placement.scale = {radius, radius, static_cast<float>(object.height_m)};
      placement.visible_to_m = 600.0f;
      place(world.builder, "pole", pole, placement);
    } else if (const auto building = town_building_of(object, number); building) {
      town.draw(*building, placement);
      ++number;
    } else if (object.kind == StandingKind::building || object.kind == StandingKind::block) {
      const Shape shape = add_shape(world.builder, "object", object_shape(object, number++), world.palette);
      placement.visible_to_m = object.kind == StandingKind::building ? 3000.0f : 900.0f;
      place(world.builder, "object", shape, placement);
    }
  }
}

}  // namespace septet::scenery

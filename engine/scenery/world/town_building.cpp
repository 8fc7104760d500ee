#include "engine/scenery/world/town_building.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/geometry/shapes.hpp"
#include "engine/scenery/world/ground_box.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using roadside::BuildingUse;

constexpr float storey_m = 2.8f;
constexpr std::array<Ground, town_walls> walls{Ground::plaster_white, Ground::brick_red,  Ground::plaster_ochre,
                                               Ground::plaster_blue,  Ground::sandstone,  Ground::plaster_rose,
                                               Ground::plaster_green, Ground::brick_brown};
constexpr std::array<Ground, 4> shops{Ground::shop_bakery, Ground::shop_chemist, Ground::shop_cafe,
                                      Ground::shop_flowers};

/// Door on its step, in the middle of the front.
void add_door(MeshBuilder& builder, float x, float front) {
  add_box(builder, Ground::kerb_stone, {x - 0.7f, front - 0.08f, -0.2f}, {x + 0.7f, front + 0.02f, 2.45f});
  add_box(builder, Ground::door, {x - 0.52f, front - 0.12f, -0.2f}, {x + 0.52f, front + 0.02f, 2.2f});
  add_box(builder, Ground::kerb_stone, {x - 0.8f, front - 0.28f, -0.4f}, {x + 0.8f, front, 0.12f});
}

void add_shop(MeshBuilder& builder, float length, float front, std::size_t variant) {
  constexpr float high = 2.95f, out = 0.07f;
  const float half = 0.5f * length - 0.35f, y = front - out;
  builder.material = index_of(shops[variant % shops.size()]);
  builder.patch({-half, y, 0.0f}, {half, y, 0.0f}, {half, y, high}, {-half, y, high});
  builder.material = index_of(Ground::kerb_stone);
  builder.patch({-half, y, high}, {half, y, high}, {half, front, high}, {-half, front, high});
  builder.patch({half, y, 0.0f}, {half, front, 0.0f}, {half, front, high}, {half, y, high});
  builder.patch({-half, front, 0.0f}, {-half, y, 0.0f}, {-half, y, high}, {-half, front, high});
  if (variant % 3 == 2) return;
  // Awning over the window, which is the left two thirds, below the name.
  const float from = -half + 0.2f, to = -half + 1.35f * half;
  constexpr float hung = 2.22f, low = 1.98f, reach = 1.0f;
  builder.material = index_of(variant % 2 == 0 ? Ground::awning_red : Ground::awning_green);
  builder.patch({from, y - reach, low}, {to, y - reach, low}, {to, y, hung}, {from, y, hung});
  builder.patch({from, y, hung}, {to, y, hung}, {to, y - reach, low}, {from, y - reach, low});
  builder.patch({from, y - reach, low - 0.2f}, {to, y - reach, low - 0.2f}, {to, y - reach, low},
                {from, y - reach, low});
}

/// Dormers in the roof's front half.
void add_dormers(MeshBuilder& builder, const HouseLook& look, float length, float width, int count) {
  const float slope = (look.ridge - look.eaves) / (0.5f * width);
  for (int i = 0; i < count; ++i) {
    const float x = length * ((static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 0.5f);
    const float y = -0.36f * width, foot = look.eaves + slope * (0.5f * width + y), top = foot + 1.25f;
    const float back = std::min(y + 1.25f / slope, 0.0f);
    add_box(builder, look.roof, {x - 0.75f, y + 0.02f, foot - 0.3f}, {x + 0.75f, back, top});
    builder.material = index_of(look.wall);
    builder.patch({x - 0.7f, y, foot - 0.1f}, {x + 0.7f, y, foot - 0.1f}, {x + 0.7f, y, top - 0.1f},
                  {x - 0.7f, y, top - 0.1f}, {{{0.3f, 0.74f}, {0.7f, 0.74f}, {0.7f, 0.22f}, {0.3f, 0.22f}}});
  }
}

void add_tower(MeshBuilder& builder, const TownBuilding& building) {
  const auto l = static_cast<float>(0.5 * building.length_m), w = static_cast<float>(0.5 * building.width_m),
             height = static_cast<float>(building.height_m), eaves = 0.6f * height;
  add_box(builder, Ground::concrete, {-l, -w, -1.5f}, {l, w, eaves});
  for (const float side : {-1.0f, 1.0f})
    add_box(builder, Ground::roof_dark, {-0.6f, side * w - 0.05f, 0.8f * eaves},
            {0.6f, side * w + 0.05f, 0.8f * eaves + 2.2f});
  builder.material = index_of(Ground::roof_dark);
  const std::uint32_t tip = builder.vertex({0, 0, height});
  const std::array corners{builder.vertex({-l - 0.2f, -w - 0.2f, eaves}), builder.vertex({l + 0.2f, -w - 0.2f, eaves}),
                           builder.vertex({l + 0.2f, w + 0.2f, eaves}), builder.vertex({-l - 0.2f, w + 0.2f, eaves})};
  for (std::size_t i = 0; i < corners.size(); ++i) builder.triangle(corners[i], corners[(i + 1) % corners.size()], tip);
}

}  // namespace

HouseLook look_of(const TownBuilding& building) {
  const auto height = static_cast<float>(building.height_m);
  const float share = building.use == BuildingUse::church ? 0.5f : building.use == BuildingUse::house ? 0.66f : 0.76f;
  const float storeys = std::max(1.0f, std::round(share * height / storey_m));
  const Ground wall = building.use == BuildingUse::church ? Ground::concrete : walls[building.variant % walls.size()];
  return {.eaves = std::min(storeys * storey_m + 0.3f, height - 1.0f),
          .ridge = height,
          .wall = wall,
          .roof = building.variant % 3 == 1 ? Ground::roof_dark : Ground::roof_tiles,
          .over_gable_m = building.use == BuildingUse::house ? 0.5f : 0.06f};
}

geometry::PolygonMesh town_building(const TownBuilding& building) {
  MeshBuilder builder;
  const HouseLook look = look_of(building);
  const auto length = static_cast<float>(building.length_m), width = static_cast<float>(building.width_m),
             front = -0.5f * width;
  if (building.use == BuildingUse::tower) {
    add_tower(builder, building);
  } else {
    add_house(builder, {building.length_m, building.width_m, 0.0, 0.0}, look);
    const bool is_row = building.use == BuildingUse::shop || building.use == BuildingUse::flats;
    if (is_row && building.variant % 4 != 1)
      add_dormers(builder, look, length, width, std::max(1, static_cast<int>(length / 5.0f)));
    if (building.use == BuildingUse::shop)
      add_shop(builder, length, front, building.variant);
    else
      add_door(builder, 0.0f, front);
  }
  geometry::PolygonMesh mesh = builder.take();
  mesh.default_edge_crease = geometry::crease_sharp;
  return mesh;
}

}  // namespace septet::scenery

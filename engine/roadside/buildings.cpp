#include "engine/roadside/buildings.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/random.hpp"

namespace septet::roadside {

std::span<const HouseBlock> house_blocks(BuildingKind kind) {
  static constexpr std::array<HouseBlock, 3> farm{
      {{12.0, 8.0, 0.0, 0.0}, {26.0, 11.0, 26.0, 18.0}, {9.0, 6.0, -16.0, 14.0}}};
  static constexpr std::array<HouseBlock, 2> church{{{22.0, 10.0, 0.0, 0.0}, {6.4, 6.4, -12.8, 0.0}}};
  if (kind == BuildingKind::church) return church;
  return farm;
}

std::vector<Building> placed_buildings(const RoadShape& roads, const Terrain& terrain, std::uint64_t seed) {
  std::vector<Building> buildings;
  Random random(seed, 3);
  int since_church = 4;
  for (road::RoadIndex index = 0; index < roads.network().roads.size(); ++index)
    for (double s = roads.begin_m(index) + 150.0; s < roads.end_m(index); s += random.uniform(260.0, 620.0)) {
      const double side = random.uniform() < 0.5 ? 1.0 : -1.0, t = side * random.uniform(120.0, 420.0),
                   turn = random.uniform(0, 2 * std::numbers::pi);
      const Vec2 p(roads.point(index, s, t));
      const Nearest near = terrain.nearest(p);
      if (!near.found || near.outside_m < 75.0 || near.is_yard() || terrain.woodland(p) > 0.02) continue;
      const double z = terrain.height_m(p, near);
      // Steep sites are left out.
      if (std::abs(terrain.height_m(p + Vec2(25, 0)) - z) + std::abs(terrain.height_m(p + Vec2(0, 25)) - z) > 4.5)
        continue;
      const bool is_church = ++since_church > 8;
      if (is_church) since_church = 0;
      const auto kind = is_church ? BuildingKind::church : static_cast<BuildingKind>(random.below(2));
      buildings.push_back({kind, {Vec3(p, z), glm::angleAxis(turn, Vec3(0, 0, 1))}});
    }
  return buildings;
}

}  // namespace septet::roadside

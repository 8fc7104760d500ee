#include "engine/roadside/plants.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_map>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "engine/geometry/noise.hpp"
#include "engine/math/plane_cells.hpp"
#include "engine/math/polygon.hpp"
#include "engine/roadside/standing_objects.hpp"
#include "engine/roadside/street.hpp"

namespace septet::roadside {
namespace {

/// Spacing of a stand of spruce ready to be thinned: about a thousand stems to the hectare.
constexpr double stem_spacing_m = 3.2;

void plant_tile(const Terrain& terrain, std::uint64_t seed, const Vec2& corner, double side_m, Random& random,
                std::vector<Tree>& trees) {
  constexpr double step = 16.0;
  for (double y = 0; y < side_m; y += step)
    for (double x = 0; x < side_m; x += step) {
      // Drawn one after the other: a compiler may evaluate a call's arguments in any order.
      const double left = random.uniform(0, step), ahead = random.uniform(0, step);
      const Vec2 p = corner + Vec2(x + ahead, y + left);
      const double chance = random.uniform(), choice = random.uniform();
      const Nearest near = terrain.nearest(p);
      if (!near.found || near.outside_m < 11.0 || near.outside_m > 330.0 || terrain.is_kept_clear(near) ||
          terrain.is_at_portal(near))
        continue;
      const double wood = near.is_yard() ? 0.0 : terrain.woodland(p),
                   group = geometry::fractal_noise(p.x / 95.0, p.y / 95.0, 2, seed + 9);
      double density = 0.012 + (group > 0.28 ? 0.20 : 0.0) + (wood > 0.02 && wood < 0.98 ? 0.38 : 0.0);
      if (wood > 0.5 && near.outside_m < 55.0) density = 0.55;  // Edge of the wood towards the road.
      if (wood > 0.5 && near.outside_m > 75.0) density = 0.05;  // Inside of the wood, which is one canopy.
      if (near.outside_m < 22.0) density *= 0.55;
      if (chance > density) continue;
      const bool conifers = geometry::fractal_noise(p.x / 300.0, p.y / 300.0, 2, seed + 11) > 0.05;
      TreeKind kind = choice < 0.14 ? TreeKind::bush
                      : conifers    ? (choice < 0.75 ? TreeKind::spruce : TreeKind::birch)
                                    : (choice < 0.62 ? TreeKind::oak : TreeKind::birch);
      if (near.outside_m < 17.0) kind = TreeKind::bush;
      Tree tree{.kind = kind, .foot_m = Vec3(p, terrain.height_m(p, near) - 0.1)};
      tree.turn_rad = random.uniform(0, 2 * std::numbers::pi);
      tree.size = random.uniform(0.75, 1.2);
      tree.variant = static_cast<int>(random.below(tree_variant_count));
      trees.push_back(tree);
    }
}

/// The file's buildings by place, for those who keep clear of them.
class BuildingPlaces {
 public:
  explicit BuildingPlaces(const std::vector<StandingObject>& objects) : objects_(objects) {
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
      if (objects[i].kind != StandingKind::building) continue;
      double reach_m = margin_m;
      for (const Vec2& corner : objects[i].footprint_m) reach_m = std::max(reach_m, glm::length(corner) + margin_m);
      const Vec2 middle(objects[i].world_from_object.position_m);
      cells.for_each(middle - reach_m, middle + reach_m, [&](std::uint64_t key) { by_cell_[key].push_back(i); });
    }
  }

  /// True within `margin_m` of a building.
  bool holds(const Vec2& p) const {
    const auto cell = by_cell_.find(cells.key_at(p));
    return cell != by_cell_.end() && std::ranges::any_of(cell->second, [&](std::uint32_t i) {
             const Vec2 local(inverse(objects_[i].world_from_object) * Vec3(p, 0.0));
             const std::vector<Vec2>& corners = objects_[i].footprint_m;
             for (const Vec2& beside :
                  {Vec2(0.0), Vec2(margin_m, 0.0), Vec2(-margin_m, 0.0), Vec2(0.0, margin_m), Vec2(0.0, -margin_m)})
               if (is_inside(corners, local + beside)) return true;
             return false;
           });
  }

 private:
  static constexpr double margin_m = 3.0;
  static constexpr PlaneCells cells{32.0};
  const std::vector<StandingObject>& objects_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> by_cell_;
};

Vec2 corner_of(const Vec2& p, double side_m) {
  return {std::floor(p.x / side_m) * side_m, std::floor(p.y / side_m) * side_m};
}

/// Size of the land's cells at p.
double cell_at(const Terrain& terrain, const Vec2& p) {
  const auto distance_m = [&](double side_m) { return terrain.distance_m(corner_of(p, side_m) + Vec2(side_m / 2)); };
  if (distance_m(far_land_tile_m) > far_land_from_m) return far_land_cell_m;
  if (distance_m(middle_land_tile_m) > middle_land_within_m || distance_m(land_tile_m) > land_within_m)
    return middle_land_cell_m;
  return land_cell_m;
}

}  // namespace

double trunk_radius_m(TreeKind kind) {
  switch (kind) {
    case TreeKind::oak:
      return 0.32;
    case TreeKind::birch:
      return 0.16;
    case TreeKind::spruce:
      return 0.22;
    case TreeKind::bush:
      return 0.8;
  }
  return 0.2;
}

std::vector<Tree> planted_trees(const RoadShape& roads, const Terrain& terrain, std::uint64_t seed) {
  std::vector<Tree> trees;
  Random random(seed, 2);
  constexpr double side = 256.0, reach = 650.0, margin = 350.0;
  const Vec2 first = glm::floor((terrain.low_m() - margin) / side), end = glm::ceil((terrain.high_m() + margin) / side);
  for (const glm::i64vec2& square : terrain.squares_near(side, reach)) {
    const Vec2 at(square), corner = at * side;
    if (at.x < first.x || at.y < first.y || at.x >= end.x || at.y >= end.y) continue;
    if (terrain.distance_m(corner + Vec2(side / 2)) < reach) plant_tile(terrain, seed, corner, side, random, trees);
  }
  const std::vector<StandingObject> objects = standing_objects(roads);
  const BuildingPlaces buildings(objects);
  std::erase_if(trees, [&](const Tree& tree) { return buildings.holds(Vec2(tree.foot_m)); });
  for (const StandingObject& object : objects) {
    if (object.kind != StandingKind::tree && object.kind != StandingKind::bush) continue;
    constexpr double level_with_road_m = 20.0;
    Vec3 foot_m = object.world_from_object.position_m;
    const Nearest near = terrain.nearest(Vec2(foot_m));
    if (near.found && near.outside_m > level_with_road_m) foot_m.z = terrain.height_m(Vec2(foot_m), near) - 0.1;
    const bool bush = object.kind == StandingKind::bush;
    constexpr double oak_m = 11.0, bush_m = 2.6;
    const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
    trees.push_back({bush ? TreeKind::bush : TreeKind::oak, foot_m, turn, object.height_m / (bush ? bush_m : oak_m),
                     static_cast<int>(trees.size() % tree_variant_count)});
  }
  const std::vector<TownHouse> houses = town_houses(roads, seed);
  std::erase_if(trees, [&](const Tree& tree) { return is_in_house(houses, Vec2(tree.foot_m), 3.5); });
  return trees;
}

bool is_wood(const Terrain& terrain, const Vec2& middle_m, double cell_m) {
  if (terrain.woodland(middle_m) < 0.5) return false;
  const Nearest near = terrain.nearest(middle_m);
  return !near.found || (!near.is_yard() && near.outside_m > 42.0 + cell_m * 0.7);
}

std::vector<Stem> wood_stems(const Terrain& terrain, std::uint64_t seed, const Vec2& p, double reach_m) {
  std::vector<Stem> stems;
  const auto index = [](double x) { return static_cast<std::int64_t>(std::floor(x / stem_spacing_m)); };
  for (std::int64_t j = index(p.y - reach_m); j <= index(p.y + reach_m); ++j)
    for (std::int64_t i = index(p.x - reach_m); i <= index(p.x + reach_m); ++i) {
      const double a = geometry::lattice_random(i, j, seed + 13), b = geometry::lattice_random(i, j, seed + 14),
                   c = geometry::lattice_random(i, j, seed + 15);
      const Vec2 middle =
          (Vec2(static_cast<double>(i), static_cast<double>(j)) + 0.2 + 0.6 * Vec2(a, b)) * stem_spacing_m;
      if (glm::distance(middle, p) > reach_m) continue;
      const double cell = cell_at(terrain, middle);
      if (!is_wood(terrain, corner_of(middle, cell) + Vec2(cell / 2), cell)) continue;
      const auto number = static_cast<std::uint32_t>((static_cast<std::uint64_t>(i) * 0x9e3779b1u) ^
                                                     (static_cast<std::uint64_t>(j) * 0x85ebca77u));
      stems.push_back({middle, 0.10 + 0.10 * c, number});
    }
  return stems;
}

}  // namespace septet::roadside

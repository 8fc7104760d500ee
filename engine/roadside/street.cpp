#include "engine/roadside/street.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "engine/math/plane_cells.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/standing_objects.hpp"
#include "engine/roadside/street_lighting.hpp"
#include "engine/roadside/town.hpp"

namespace septet::roadside {
namespace {

constexpr std::size_t most_houses = 6000;
constexpr double house_clear_m = 2.0, signal_clear_m = 3.0, least_gap_m = 2.5;
constexpr PlaneCells house_cells{32.0};

/// Distance from p to the nearest road's lanes, at most 8 m.
double off_roads_m(const road::RoadNetwork& network, const Vec2& p) {
  const auto found = road::locate(network, p, nullptr, 8.0);
  return found ? found->lanes.outside_m : 8.0;
}

bool is_in(const TownHouse& house, const Vec2& p, double margin_m) {
  const TownHouseSize size = size_of(house.kind);
  const Vec2 middle(house.world_from_house.position_m);
  if (glm::distance(middle, p) > 0.5 * std::hypot(size.length_m, size.depth_m) + margin_m) return false;
  const Vec3 local = inverse(house.world_from_house) * Vec3(p, 0.0);
  return std::abs(local.x) < 0.5 * size.length_m + margin_m && std::abs(local.y) < 0.5 * size.depth_m + margin_m;
}

class LotBuilder {
 public:
  LotBuilder(const RoadShape& roads, std::vector<TownHouse>& houses) : roads_(roads), houses_(houses) {
    for (road::RoadIndex index = 0; index < roads.network().roads.size(); ++index)
      for (const road::Signal& signal : roads.road(index).signals) {
        const Vec2 p(roads.point(index, signal.s_m, signal.t_m));
        signals_[house_cells.key_at(p)].push_back(p);
      }
  }

  void line(road::RoadIndex index, double side, Random& random) {
    const road::Road& road = roads_.road(index);
    // Lots follow one another; a lot that is not clear is left empty.
    double s = random.uniform(4.0, 10.0);
    while (s < road.length_m && houses_.size() < most_houses) {
      const double choice = random.uniform(), gap = random.uniform(5.0, 12.0), back = random.uniform(4.0, 7.0);
      const auto colour = static_cast<int>(random.below(town_house_colour_count));
      const TownHouseKind kind = choice < 0.45   ? TownHouseKind::house
                                 : choice < 0.75 ? TownHouseKind::cottage
                                                 : TownHouseKind::block;
      const TownHouseSize size = size_of(kind);
      const double middle_s = s + 0.5 * size.length_m;
      s += size.length_m + gap;
      if (s - gap > road.length_m || !is_in_town(roads_.network(), index, middle_s) || is_on_structure(index, middle_s))
        continue;
      place({kind, colour, {}}, index, middle_s, side, back + 0.5 * size.depth_m);
    }
  }

 private:
  bool is_on_structure(road::RoadIndex index, double s_m) const {
    return std::ranges::any_of(roads_.road(index).structures, [&](const road::RoadStructure& structure) {
      return s_m > structure.s_m - 20.0 && s_m < structure.s_m + structure.length_m + 20.0;
    });
  }

  void place(TownHouse house, road::RoadIndex index, double s, double side, double out_m) {
    const road::RoadExtent extent = road::road_extent(roads_.road(index), s);
    const double edge_t = side > 0 ? extent.left_t_m : extent.right_t_m;
    const road::RoadPoint edge = roads_.at(index, s, edge_t);
    const Vec2 out = Vec2(-std::sin(edge.heading_rad), std::cos(edge.heading_rad)) * side;
    house.world_from_house = {
        Vec3(Vec2(edge.position_m) + out * out_m, edge.position_m.z - 0.1),
        orientation_from_angles(edge.heading_rad + (side > 0 ? 0.0 : std::numbers::pi), 0.0, 0.0)};
    if (!is_clear(house)) return;
    const TownHouseSize size = size_of(house.kind);
    const Vec2 middle(house.world_from_house.position_m), reach(0.5 * std::hypot(size.length_m, size.depth_m));
    const auto number = static_cast<std::uint32_t>(houses_.size());
    house_cells.for_each(middle - reach, middle + reach, [&](std::uint64_t key) { cells_[key].push_back(number); });
    houses_.push_back(house);
  }

  bool is_clear(const TownHouse& house) const {
    const TownHouseSize size = size_of(house.kind);
    const Vec2 half(0.5 * size.length_m, 0.5 * size.depth_m), middle(house.world_from_house.position_m);
    std::vector<Vec2> places;
    for (int y = -2; y <= 2; ++y)
      for (int x = -3; x <= 3; ++x)
        places.emplace_back(house.world_from_house * Vec3(half.x * x / 3.0, half.y * y / 2.0, 0.0));
    for (const Vec2& p : places)
      if (off_roads_m(roads_.network(), p) < house_clear_m) return false;
    const Vec2 reach(glm::length(half) + least_gap_m);
    bool clear = true;
    house_cells.for_each(middle - reach, middle + reach, [&](std::uint64_t key) {
      if (const auto cell = cells_.find(key); cell != cells_.end())
        for (const std::uint32_t number : cell->second)
          clear &= std::ranges::none_of(places, [&](const Vec2& p) { return is_in(houses_[number], p, least_gap_m); });
      if (const auto cell = signals_.find(key); cell != signals_.end())
        clear &= std::ranges::none_of(cell->second, [&](const Vec2& p) { return is_in(house, p, signal_clear_m); });
    });
    return clear;
  }

  const RoadShape& roads_;
  std::vector<TownHouse>& houses_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
  std::unordered_map<std::uint64_t, std::vector<Vec2>> signals_;
};

}  // namespace

TownHouseSize size_of(TownHouseKind kind) {
  switch (kind) {
    case TownHouseKind::cottage:
      return {10.0, 8.0};
    case TownHouseKind::house:
      return {12.0, 9.0};
    case TownHouseKind::block:
      return {20.0, 11.0};
  }
  return {10.0, 8.0};
}

std::vector<TownHouse> town_houses(const RoadShape& roads, std::uint64_t seed) {
  std::vector<TownHouse> houses;
  if (gives(roads.network(), StandingKind::building)) return houses;
  LotBuilder builder(roads, houses);
  for (road::RoadIndex index = 0; index < roads.network().roads.size(); ++index) {
    if (roads.road(index).junction != road::no_index) continue;
    for (const double side : {1.0, -1.0}) {
      Random random(seed, 1000 + 2 * static_cast<std::uint64_t>(index) + (side > 0 ? 1 : 0));
      builder.line(index, side, random);
    }
  }
  return houses;
}

std::vector<StreetLamp> street_lamps(const RoadShape& roads) {
  if (!gives(roads.network(), StandingKind::lamp)) return planned_lamps(roads);
  std::vector<StreetLamp> lamps;
  for (const StandingObject& object : standing_objects(roads))
    if (object.kind == StandingKind::lamp && lamps.size() < most_lamps) lamps.push_back({object.world_from_object});
  return lamps;
}

bool is_in_house(const std::vector<TownHouse>& houses, const Vec2& p, double margin_m) {
  return std::ranges::any_of(houses, [&](const TownHouse& house) { return is_in(house, p, margin_m); });
}

}  // namespace septet::roadside

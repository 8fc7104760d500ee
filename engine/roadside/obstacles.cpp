#include "engine/roadside/obstacles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/math/plane_cells.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/barrier_lines.hpp"
#include "engine/roadside/buildings.hpp"
#include "engine/roadside/obstacle_profile.hpp"
#include "engine/roadside/parked_cars.hpp"
#include "engine/roadside/plants.hpp"
#include "engine/roadside/signals.hpp"
#include "engine/roadside/standing_objects.hpp"
#include "engine/roadside/street.hpp"
#include "engine/roadside/street_furniture.hpp"
#include "engine/roadside/tunnel_shape.hpp"
#include "engine/world/participant_sight.hpp"

namespace septet::roadside {
namespace {

constexpr PlaneCells obstacle_cells{32.0};
constexpr double most_reach_m = 30.0, farthest_m = 1e9;
constexpr std::uint32_t stem_runs = 0x8000'0000u;  // Run numbers of obstacles outside the list.

using Things = std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t>;

Things::key_type millimetres(const Vec2& place_m) {
  return {std::llround(1e3 * place_m.x), std::llround(1e3 * place_m.y)};
}

class Builder {
 public:
  Builder(std::vector<Obstacle>& obstacles, std::vector<sight::Wall>& walls, Things& things)
      : obstacles_(obstacles), walls_(walls), things_(things) {}

  /// What `add` adds is drawn by the one object of the scene at this place.
  template <class Add>
  void thing(const Vec3& place_m, const Add& add) {
    const auto next = static_cast<std::uint32_t>(things_.size() + 1);
    const auto [thing, is_new] = things_.try_emplace(millimetres(Vec2(place_m)), next);
    const std::size_t before = obstacles_.size();
    thing_ = thing->second;
    add();
    thing_ = 0;
    if (is_new && obstacles_.size() == before) things_.erase(thing);  // Nothing of it can be hit.
  }

  void point(ObstacleKind kind, const Vec3& foot_m, double radius_m) { add(kind, run_++, foot_m, foot_m, radius_m); }

  /// Adds a run of straight stretches, whose inner joints are closed.
  void line(ObstacleKind kind, const std::vector<Vec3>& points_m) { line(kind, points_m, profile_of(kind).hides_m); }
  /// `hides_m`: as of its profile.
  void line(ObstacleKind kind, const std::vector<Vec3>& points_m, double hides_m) {
    if (points_m.size() < 2) return;
    for (std::size_t i = 0; i + 1 < points_m.size(); ++i) {
      Obstacle& stretch = add(kind, run_, points_m[i], points_m[i + 1], profile_of(kind).radius_m);
      stretch.open_from = i == 0;
      stretch.open_to = i + 2 == points_m.size();
      if (hides_m > 0.0)
        walls_.push_back({stretch.from_m, stretch.to_m, stretch.low_m,
                          std::max(points_m[i].z, points_m[i + 1].z) + hides_m, thing_});
    }
    ++run_;
  }

 private:
  Obstacle& add(ObstacleKind kind, std::uint32_t run, const Vec3& from_m, const Vec3& to_m, double radius_m) {
    const ObstacleProfile profile = profile_of(kind);
    Obstacle obstacle;
    obstacle.kind = kind;
    obstacle.run = run;
    obstacle.from_m = Vec2(from_m);
    obstacle.to_m = Vec2(to_m);
    obstacle.radius_m = radius_m;
    obstacle.low_m = profile.height_m < endless_m ? std::min(from_m.z, to_m.z) - 0.3 : -endless_m;
    obstacle.high_m = std::max(from_m.z, to_m.z) + profile.height_m;
    obstacle.friction = profile.friction;
    obstacle.yielding_kg = profile.yielding_kg;
    obstacle.thing = thing_;
    return obstacles_.emplace_back(obstacle);
  }

  std::vector<Obstacle>& obstacles_;
  std::vector<sight::Wall>& walls_;
  Things& things_;
  std::uint32_t run_ = 0, thing_ = 0;
};

/// Joins a line's pieces from one tile to the next.
class LineJoiner {
 public:
  LineJoiner(Builder& builder, ObstacleKind kind) : builder_(builder), kind_(kind) {}
  ~LineJoiner() { flush(); }

  void add(const std::vector<Vec3>& points_m) {
    if (points_m.empty()) return;
    if (!points_.empty() && glm::distance(points_.back(), points_m.front()) > 0.05) flush();
    points_.insert(points_.end(), points_m.begin() + (points_.empty() ? 0 : 1), points_m.end());
  }

 private:
  void flush() {
    builder_.line(kind_, points_);
    points_.clear();
  }

  Builder& builder_;
  ObstacleKind kind_;
  std::vector<Vec3> points_;
};

std::vector<Vec3> points(const RoadShape& roads, const RoadTile& tile, const BesideLine& line, double step_m) {
  std::vector<Vec3> result;
  for (const double s : stations(tile, line, step_m)) result.push_back(roads.point(tile.road, s, line.t_at(s)));
  return result;
}

ObstacleKind kind_of(BarrierForm form) {
  switch (form) {
    case BarrierForm::jersey:
      return ObstacleKind::concrete_barrier;
    case BarrierForm::railing:
    case BarrierForm::fence:
    case BarrierForm::hedge:
      return ObstacleKind::parapet;
    case BarrierForm::wall:
      return ObstacleKind::noise_wall;
    case BarrierForm::rail:
      break;
  }
  return ObstacleKind::guard_rail;
}

void add_barriers(const RoadShape& roads, const std::vector<RoadTile>& tiles, Builder& builder) {
  std::vector<std::vector<Barrier>> all;
  all.reserve(tiles.size());
  for (const RoadTile& tile : tiles) all.push_back(barriers(roads, tile));
  for (const BarrierForm form : barrier_forms) {
    std::vector<std::vector<BesideLine>> lines(tiles.size());
    std::size_t most = 0;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      for (const Barrier& barrier : all[i])
        if (barrier.form == form) lines[i].push_back(barrier.line);
      most = std::max(most, lines[i].size());
    }
    for (std::size_t k = 0; k < most; ++k) {  // One line is one run along all tiles of its road.
      LineJoiner joiner(builder, kind_of(form));
      for (std::size_t i = 0; i < tiles.size(); ++i)
        if (k < lines[i].size()) joiner.add(points(roads, tiles[i], lines[i][k], barrier_step_m));
    }
  }
}

void add_walls_and_posts(const RoadShape& roads, const std::vector<RoadTile>& tiles, Builder& builder) {
  LineJoiner walls(builder, ObstacleKind::noise_wall);
  for (const RoadTile& tile : tiles) {
    for (const BesideLine& line : noise_walls(roads, tile)) walls.add(points(roads, tile, line, noise_wall_step_m));
    for (const BesideLine& line : marker_posts(roads, tile))
      if (const auto foot = points(roads, tile, line, marker_post_step_m); !foot.empty())
        builder.point(ObstacleKind::marker_post, foot.front(), profile_of(ObstacleKind::marker_post).radius_m);
  }
}

void add_tunnels(const RoadShape& roads, const std::vector<RoadTile>& tiles, Builder& builder) {
  using namespace tunnel_shape;
  for (int wall = -1; wall <= 1; ++wall) {
    LineJoiner joiner(builder, ObstacleKind::tunnel_wall);
    for (const RoadTile& tile : tiles) {
      if (!tile.in_tunnel) continue;
      std::vector<Vec3> line;
      for (const double s : stations(tile, 20.0)) {
        const road::RoadExtent extent = road::road_extent(roads.road(tile.road), s);
        const double t = wall > 0 ? extent.left_t_m + wall_clear_m : wall < 0 ? extent.right_t_m - wall_clear_m : 0.0;
        line.push_back(roads.point(tile.road, s, t));
      }
      joiner.add(line);
    }
  }
  const double half = profile_of(ObstacleKind::portal).radius_m;
  for (road::RoadIndex index = 0; index < roads.network().roads.size(); ++index)
    for (const road::RoadStructure& tunnel : roads.road(index).structures) {
      if (tunnel.kind != road::RoadStructure::Kind::tunnel) continue;
      for (const double mouth : {tunnel.s_m, tunnel.s_m + tunnel.length_m}) {
        const road::RoadExtent extent = road::road_extent(roads.road(index), mouth);
        for (const auto& [inner, outer] :
             {std::pair(extent.left_t_m + wall_clear_m + half, extent.left_t_m + portal_out_m),
              std::pair(extent.right_t_m - wall_clear_m - half, extent.right_t_m - portal_out_m)})
          builder.line(ObstacleKind::portal, {roads.point(index, mouth, inner), roads.point(index, mouth, outer)});
      }
    }
}

void add_gantries(const RoadShape& roads, Builder& builder) {
  for (road::RoadIndex index = 0; index < roads.network().roads.size(); ++index)
    for (const road::RoadObject& object : roads.road(index).objects) {
      if (object.type != "gantry") continue;
      const road::RoadPoint middle = roads.at(index, object.s_m, object.t_m);
      const Vec3 left(-std::sin(middle.heading_rad), std::cos(middle.heading_rad), 0.0);
      builder.thing(middle.position_m, [&] {
        for (const double y : gantry_legs_m(object.width_m))
          builder.point(ObstacleKind::gantry_leg, middle.position_m + y * left,
                        profile_of(ObstacleKind::gantry_leg).radius_m);
      });
    }
}

void add_signals(const RoadShape& roads, Builder& builder) {
  for (const StandingSignal& standing : standing_signals(roads))
    if (standing.has_post)
      builder.point(ObstacleKind::post, standing.world_from_signal.position_m, profile_of(ObstacleKind::post).radius_m);
  for (const StreetLamp& lamp : street_lamps(roads)) {
    const Vec3& foot_m = lamp.world_from_lamp.position_m;
    builder.thing(foot_m, [&] { builder.point(ObstacleKind::post, foot_m, 0.07); });
  }
}

void add_house(const RigidTransform& world_from_house, const HouseBlock& block, Builder& builder,
               double hides_m = profile_of(ObstacleKind::house).hides_m) {
  const auto corner = [&](double x, double y) {
    return world_from_house * Vec3(block.x_m + x * block.length_m / 2, block.y_m + y * block.width_m / 2, 0.0);
  };
  const std::array<Vec3, 4> corners{corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
  for (std::size_t i = 0; i < corners.size(); ++i)  // Own run for each wall: two are met at once, neither is hidden.
    builder.line(ObstacleKind::house, {corners[i], corners[(i + 1) % corners.size()]}, hides_m);
}

/// Adds objects of the road file, except its trees and lamps, which are among those above and below.
void add_objects(const RoadShape& roads, Builder& builder) {
  for (const StandingObject& object : standing_objects(roads))
    builder.thing(object.world_from_object.position_m, [&] {
      if (object.kind == StandingKind::pole)
        builder.point(ObstacleKind::post, object.world_from_object.position_m, object.radius_m);
      for (std::size_t i = 0; i < object.footprint_m.size(); ++i) {
        const auto corner = [&](std::size_t n) {
          return object.world_from_object * Vec3(object.footprint_m[n % object.footprint_m.size()], 0.0);
        };
        builder.line(ObstacleKind::house, {corner(i), corner(i + 1)}, object.height_m);
      }
    });
}

void add_furniture(const RoadShape& roads, std::uint64_t seed, Builder& builder) {
  for (const Furniture& thing : street_furniture(roads, seed))
    if (const double radius_m = radius_of(thing.kind); radius_m > 0.0) {
      const Vec3& foot_m = thing.world_from_thing.position_m;
      builder.thing(foot_m, [&] { builder.point(ObstacleKind::post, foot_m, radius_m); });
    }
}

void add_parked_cars(const RoadShape& roads, std::uint64_t seed, Builder& builder) {
  for (const ParkedCar& car : parked_cars(roads, seed)) {
    const VehicleModel& model = vehicle_models()[car.model];
    builder.thing(car.world_from_vehicle.position_m, [&] {
      add_house(car.world_from_vehicle, {model.length_m, model.width_m, model.centre_x_m(), 0.0}, builder,
                opaque_height_m(model));
    });
  }
}

void add_land(const RoadShape& roads, const Terrain& terrain, std::uint64_t seed, Builder& builder) {
  for (const Tree& tree : planted_trees(roads, terrain, seed))
    builder.thing(tree.foot_m, [&] {
      builder.point(tree.kind == TreeKind::bush ? ObstacleKind::bush : ObstacleKind::tree, tree.foot_m,
                    trunk_radius_m(tree.kind) * tree.size);
    });
  for (const Building& building : placed_buildings(roads, terrain, seed))
    builder.thing(building.world_from_building.position_m, [&] {
      for (const HouseBlock& block : house_blocks(building.kind))
        add_house(building.world_from_building, block, builder);
    });
  for (const TownHouse& house : town_houses(roads, seed)) {
    const TownHouseSize size = size_of(house.kind);
    builder.thing(house.world_from_house.position_m, [&] {
      add_house(house.world_from_house, {size.length_m, size.depth_m, 0.0, 0.0}, builder);
    });
  }
}

double distance_m(const Obstacle& obstacle, const Vec2& p) {
  const Vec2 along = obstacle.to_m - obstacle.from_m;
  const double square = glm::dot(along, along);
  const double share = square > 0.0 ? std::clamp(glm::dot(p - obstacle.from_m, along) / square, 0.0, 1.0) : 0.0;
  return glm::distance(p, obstacle.from_m + share * along);
}

}  // namespace

std::vector<double> gantry_legs_m(double gantry_width_m) { return {-0.5 * gantry_width_m, 0.0, 0.5 * gantry_width_m}; }

Obstacles::Obstacles(const road::RoadNetwork& network, std::uint64_t seed, double overrun_m)
    : seed_(seed), terrain_(RoadShape(network, overrun_m), seed) {
  const RoadShape roads(network, overrun_m);
  const std::vector<RoadTile> tiles = roads.tiles(160.0);
  std::vector<sight::Wall> walls;
  Builder builder(obstacles_, walls, things_);
  add_barriers(roads, tiles, builder);
  add_walls_and_posts(roads, tiles, builder);
  add_tunnels(roads, tiles, builder);
  add_gantries(roads, builder);
  add_signals(roads, builder);
  add_objects(roads, builder);
  add_parked_cars(roads, seed, builder);
  add_furniture(roads, seed, builder);
  add_land(roads, terrain_, seed, builder);
  close_ends();
  index();
  walls_ = sight::Walls(std::move(walls));
  for (road::RoadIndex road = 0; road < network.roads.size(); ++road)
    for (double s = roads.begin_m(road); s < roads.end_m(road); s += 12.0) {
      const road::RoadExtent extent = road::road_extent(network.roads[road], s);
      for (double t = extent.right_t_m; t <= extent.left_t_m; t += 12.0) {
        const Vec3 p = roads.point(road, s, t);
        treeless_.insert(obstacle_cells.key_at(p));
      }
    }
}

/// Closes the ends of rails that continue as another one, of the next road or of another make: they are no ends to run
/// into.
void Obstacles::close_ends() {
  struct End {
    Vec2 at, outwards;
    bool* open;
  };
  std::vector<End> ends;
  for (Obstacle& obstacle : obstacles_) {
    if (obstacle.from_m == obstacle.to_m) continue;
    const Vec2 along = glm::normalize(obstacle.to_m - obstacle.from_m);
    if (obstacle.open_from) ends.push_back({obstacle.from_m, -along, &obstacle.open_from});
    if (obstacle.open_to) ends.push_back({obstacle.to_m, along, &obstacle.open_to});
  }
  std::ranges::sort(ends, {}, [](const End& end) { return end.at.x; });
  constexpr double near_m = 0.75, straight = 0.9;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t k = i + 1; k < ends.size() && ends[k].at.x - ends[i].at.x < near_m; ++k)
      if (glm::distance(ends[i].at, ends[k].at) < near_m && glm::dot(ends[i].outwards, ends[k].outwards) < -straight)
        *ends[i].open = *ends[k].open = false;
}

void Obstacles::index() {
  for (std::uint32_t i = 0; i < obstacles_.size(); ++i) {
    const Obstacle& obstacle = obstacles_[i];
    obstacle_cells.for_each(glm::min(obstacle.from_m, obstacle.to_m) - obstacle.radius_m,
                            glm::max(obstacle.from_m, obstacle.to_m) + obstacle.radius_m,
                            [&](std::uint64_t key) { cells_[key].push_back(i); });
  }
}

std::uint32_t Obstacles::thing_at(const Vec2& place_m) const {
  if (!(std::abs(place_m.x) < farthest_m && std::abs(place_m.y) < farthest_m)) return 0;
  const auto found = things_.find(millimetres(place_m));
  return found == things_.end() ? 0 : found->second;
}

std::vector<Obstacle> Obstacles::near(const Vec2& p, double wanted_reach_m, std::span<const std::uint32_t> gone) const {
  std::vector<Obstacle> found;
  if (!(std::abs(p.x) < endless_m && std::abs(p.y) < endless_m && wanted_reach_m >= 0.0)) return found;
  const double reach_m = std::min(wanted_reach_m, most_reach_m);
  std::vector<std::uint32_t> numbers;
  bool may_be_wood = false;
  obstacle_cells.for_each(p - reach_m, p + reach_m, [&](std::uint64_t key) {
    may_be_wood |= !treeless_.contains(key);
    const auto cell = cells_.find(key);
    if (cell == cells_.end()) return;
    for (const std::uint32_t i : cell->second)
      if (distance_m(obstacles_[i], p) < reach_m + obstacles_[i].radius_m &&
          !std::ranges::binary_search(gone, obstacles_[i].thing))
        numbers.push_back(i);
  });
  std::ranges::sort(numbers);
  // Uses std::unique, as clang 14 cannot compile std::ranges::unique.
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  for (const std::uint32_t i : numbers) found.push_back(obstacles_[i]);
  if (may_be_wood)
    for (const Stem& stem : wood_stems(terrain_, seed_, p, reach_m)) {
      constexpr ObstacleProfile profile = profile_of(ObstacleKind::tree);
      found.push_back({.kind = ObstacleKind::tree,
                       .run = stem_runs | stem.number,
                       .from_m = stem.middle_m,
                       .to_m = stem.middle_m,
                       .radius_m = stem.radius_m,
                       .low_m = -endless_m,
                       .high_m = endless_m,
                       .friction = profile.friction});
    }
  return found;
}

}  // namespace septet::roadside

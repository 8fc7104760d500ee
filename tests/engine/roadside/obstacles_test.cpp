#include "engine/roadside/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/plants.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/engine/road/third_party_road.hpp"
#include "tests/relative.hpp"

namespace septet::roadside {
namespace {

const Obstacles& motorway_obstacles() {
  static const Obstacles obstacles(road::motorway(), 1);
  return obstacles;
}

Vec2 on_motorway(double s_m, double t_m) { return Vec2(road::evaluate(road::motorway(), {0, s_m, t_m}).position_m); }

std::vector<ObstacleKind> kinds_near(const Vec2& p, double reach_m) {
  std::vector<ObstacleKind> kinds;
  for (const Obstacle& obstacle : motorway_obstacles().near(p, reach_m)) kinds.push_back(obstacle.kind);
  return kinds;
}

}  // namespace

TEST_CASE("every kind of thing stands beside the motorway") {
  std::map<ObstacleKind, int> count;
  for (const Obstacle& obstacle : motorway_obstacles().listed()) ++count[obstacle.kind];
  for (int kind = 0; kind <= static_cast<int>(ObstacleKind::house); ++kind) {
    CAPTURE(name_of(static_cast<ObstacleKind>(kind)));
    CHECK(count[static_cast<ObstacleKind>(kind)] > 0);
  }
  CHECK(count[ObstacleKind::marker_post] > 200);
  CHECK(count[ObstacleKind::tree] > 1000);
}

TEST_CASE(
    "rails and the wall between the carriageways are found where the road file has them and nothing in the lanes") {
  for (const double s : {100.0, 901.5, 3100.0, 5500.0}) {
    CAPTURE(s);
    const auto middle = kinds_near(on_motorway(s, 0.0), 1.0);
    CHECK(!middle.empty());
    CHECK(std::ranges::count(middle, ObstacleKind::concrete_barrier) == static_cast<std::ptrdiff_t>(middle.size()));
    CHECK(std::ranges::count(kinds_near(on_motorway(s, 23.85), 1.0), ObstacleKind::guard_rail) > 0);
    for (const double t : {-3.0, -11.0, -20.0, 3.0, 20.0}) CHECK(kinds_near(on_motorway(s, t), 1.2).empty());
  }
}

TEST_CASE("nothing that is put beside a road stands on the lanes of another") {
  // Marker posts of an exit's gore; trees and houses. Objects of the road file itself stay at their places.
  const auto stands_on_lanes = [](const road::RoadNetwork& network) {
    int count = 0;
    const Obstacles obstacles(network, 1);
    for (const Obstacle& obstacle : obstacles.listed()) {
      if (obstacle.kind != ObstacleKind::marker_post && obstacle.kind != ObstacleKind::tree &&
          obstacle.kind != ObstacleKind::bush)
        continue;
      for (const road::Location& location : road::roads_holding(network, obstacle.from_m)) {
        const road::RoadPosition& at = location.position;
        const auto type = road::lane_type(network, at.road, location.lanes.lane_any_type, at.s_m);
        if (type == road::LaneType::none) continue;
        ++count;
        MESSAGE(name_of(obstacle.kind) << " on road " << network.roads[at.road].id << " at s=" << at.s_m
                                       << ", t=" << at.t_m);
      }
    }
    return count;
  };
  CHECK(stands_on_lanes(road::motorway()) == 0);
  for (const char* name : {"highway_exit", "e6mini", "soderleden", "curves_elevation"}) {
    CAPTURE(name);
    CHECK(stands_on_lanes(road::third_party_road(name)) == 0);
  }
}

TEST_CASE("a rail is one run without joints over kilometres and its loose ends are open") {
  std::map<std::uint32_t, std::vector<Obstacle>> runs;
  for (const Obstacle& obstacle : motorway_obstacles().listed())
    if (obstacle.kind == ObstacleKind::guard_rail) runs[obstacle.run].push_back(obstacle);
  std::size_t longest = 0;
  for (const auto& [run, stretches] : runs) {
    longest = std::max(longest, stretches.size());
    for (std::size_t i = 0; i + 1 < stretches.size(); ++i) {
      CHECK(glm::distance(stretches[i].to_m, stretches[i + 1].from_m) < 1e-9);
      CHECK_FALSE(stretches[i].open_to);
      CHECK_FALSE(stretches[i + 1].open_from);
    }
  }
  CHECK(longest > 200);
}

TEST_CASE("stems stand in the woods that are drawn and nowhere else") {
  const Terrain terrain(RoadShape(road::motorway(), usual_overrun_m), 1);
  int in_wood = 0, in_field = 0;
  double most_free_m = 0.0;
  for (double s = 100.0; s < 6000.0; s += 50.0)
    for (const double t : {-150.0, -100.0, 100.0, 150.0}) {
      const Vec2 p = on_motorway(s, t);
      const Vec2 cell = glm::floor(p / land_cell_m), middle = (cell + 0.5) * land_cell_m;
      const auto found = motorway_obstacles().near(middle, 5.0);
      if (!is_wood(terrain, middle, land_cell_m)) {
        in_field += static_cast<int>(
            std::ranges::count_if(found, [](const Obstacle& o) { return (o.run & 0x8000'0000u) != 0; }));
        continue;
      }
      ++in_wood;
      double nearest_m = INFINITY;
      for (const Obstacle& obstacle : found) nearest_m = std::min(nearest_m, glm::distance(obstacle.from_m, middle));
      most_free_m = std::max(most_free_m, nearest_m);
    }
  CHECK(in_wood > 20);
  CHECK(in_field == 0);
  CHECK(most_free_m < 4.0);
}

TEST_CASE("the same seed gives the same obstacles and another seed other trees") {
  const Obstacles again(road::motorway(), 1), other(road::motorway(), 2);
  const auto& first = motorway_obstacles();
  REQUIRE(again.listed().size() == first.listed().size());
  for (std::size_t i = 0; i < first.listed().size(); ++i) CHECK(again.listed()[i].from_m == first.listed()[i].from_m);
  CHECK(other.listed().size() != first.listed().size());
}

TEST_CASE("a road without anything beside it has nothing to hit on it") {
  CHECK(Obstacles(road::RoadNetwork{}, 1).near({0.0, 0.0}, 5.0).empty());
}

TEST_CASE("near a place that is no number there is nothing and nothing is further than thirty metres") {
  const double bad = std::nan("");
  CHECK(motorway_obstacles().near({bad, 0.0}, 5.0).empty());
  CHECK(motorway_obstacles().near({0.0, bad}, 5.0).empty());
  CHECK(motorway_obstacles().near(on_motorway(901.5, 0.0), bad).empty());
  CHECK(motorway_obstacles().near({1e300, 0.0}, 5.0).empty());
  const Vec2 middle = on_motorway(901.5, 0.0);
  CHECK(motorway_obstacles().near(middle, 1e30).size() == motorway_obstacles().near(middle, 30.0).size());
}

TEST_CASE("what is near is what of the list lies within reach, from edge to place") {
  const auto distance_m = [](const Obstacle& obstacle, const Vec2& p) {
    double least_m = INFINITY;
    for (int i = 0; i <= 1000; ++i)
      least_m = std::min(least_m, glm::distance(p, glm::mix(obstacle.from_m, obstacle.to_m, i / 1000.0)));
    return least_m - obstacle.radius_m;
  };
  for (double s = 20.0; s < 7000.0; s += 431.0)
    for (const double t : {-45.0, -21.0, 0.0, 23.0, 60.0})
      for (const double reach_m : {2.0, 12.0, 30.0}) {
        const Vec2 p = on_motorway(s, t);
        std::vector<const Obstacle*> expected, doubtful;
        for (const Obstacle& obstacle : motorway_obstacles().listed()) {
          if (glm::distance(obstacle.from_m, p) > 120.0) continue;
          const double away_m = distance_m(obstacle, p);
          if (std::abs(away_m - reach_m) < 0.06)
            doubtful.push_back(&obstacle);
          else if (away_m < reach_m)
            expected.push_back(&obstacle);
        }
        auto found = motorway_obstacles().near(p, reach_m);
        std::erase_if(found, [](const Obstacle& o) { return (o.run & 0x8000'0000u) != 0; });
        const auto is_found = [&](const Obstacle* wanted) {
          return std::ranges::count_if(found, [&](const Obstacle& o) {
            return o.run == wanted->run && o.from_m == wanted->from_m && o.to_m == wanted->to_m;
          });
        };
        CAPTURE(s);
        CAPTURE(t);
        CAPTURE(reach_m);
        for (const Obstacle* obstacle : expected) CHECK(is_found(obstacle) == 1);
        CHECK(found.size() >= expected.size());
        CHECK(found.size() <= expected.size() + doubtful.size());
      }
}

TEST_CASE("a tunnel has walls half a metre beside its lanes and between them, up to where its ceiling begins") {
  const road::Road& road = road::motorway().roads[0];
  const auto tunnel = std::ranges::find(road.structures, road::RoadStructure::Kind::tunnel, &road::RoadStructure::kind);
  REQUIRE(tunnel != road.structures.end());
  const auto walls_at = [&](double s_m, double t_m) {
    auto found = motorway_obstacles().near(on_motorway(s_m, t_m), 0.02);
    std::erase_if(found, [](const Obstacle& o) { return o.kind != ObstacleKind::tunnel_wall; });
    return found;
  };
  for (const double in_m : {15.0, 400.0, 785.0}) {
    const double s = tunnel->s_m + in_m;
    const road::RoadExtent extent = road::road_extent(road, s);
    for (const double t : {extent.left_t_m + 0.5, 0.0, extent.right_t_m - 0.5}) {
      CAPTURE(s);
      CAPTURE(t);
      const auto walls = walls_at(s, t);
      REQUIRE(walls.size() >= 1);
      const double road_z_m = road::evaluate(road::motorway(), {0, s, t}).position_m.z;
      CHECK(walls.front().low_m < road_z_m);
      CHECK(walls.front().low_m > road_z_m - 1.5);
      CHECK(walls.front().high_m > road_z_m + 4.99);
      CHECK(walls.front().high_m < road_z_m + 6.0);
      CHECK(walls.front().friction == 0.45);
      CHECK(walls.front().yielding_kg == 0.0);
    }
    CHECK(walls_at(s, extent.left_t_m + 0.2).empty());
    CHECK(walls_at(s, extent.right_t_m - 0.8).empty());
  }
  CHECK(walls_at(tunnel->s_m - 3.0, 0.0).empty());
  CHECK(walls_at(tunnel->s_m + tunnel->length_m + 3.0, 0.0).empty());
  std::vector<double> lengths;
  for (const Obstacle& obstacle : motorway_obstacles().listed())
    if (obstacle.kind == ObstacleKind::portal) lengths.push_back(glm::distance(obstacle.from_m, obstacle.to_m));
  REQUIRE(lengths.size() == 4);
  for (const double length_m : lengths) CHECK(length_m == relative(46.0 - 0.5 - 0.45, 1e-3));
}

TEST_CASE("marker posts yield and stand every fifty metres a little outside of the lanes but not where a wall is") {
  const road::Road& road = road::motorway().roads[0];
  const auto posts_at = [&](double s_m, double side) {
    const road::RoadExtent extent = road::road_extent(road, s_m);
    auto found = motorway_obstacles().near(
        on_motorway(s_m - 0.5, side > 0.0 ? extent.left_t_m + 1.2 : extent.right_t_m - 1.2), 0.05);
    std::erase_if(found, [](const Obstacle& o) { return o.kind != ObstacleKind::marker_post; });
    return found;
  };
  for (const double s : {100.0, 150.0, 900.0, 5500.0})
    for (const double side : {-1.0, 1.0}) {
      CAPTURE(s);
      const auto posts = posts_at(s, side);
      REQUIRE(posts.size() == 1);
      CHECK(posts.front().yielding_kg == 3.0);
      CHECK(posts.front().from_m == posts.front().to_m);
      const double z_m = road::evaluate(road::motorway(), {0, s, 0.0}).position_m.z;
      CHECK(std::abs(posts.front().high_m - z_m - 1.05) < 0.8);  // The road is tilted.
      CHECK(posts_at(s + 25.0, side).empty());
    }
  for (const double s : {1200.0, 1250.0, 3300.0, 3900.0}) CHECK(posts_at(s, 1.0).empty());
}

TEST_CASE("a house is a wall all round, no nearer to a road than seventy-five metres less its half") {
  const Terrain terrain(RoadShape(road::motorway(), usual_overrun_m), 1);
  std::vector<Obstacle> walls;
  for (const Obstacle& obstacle : motorway_obstacles().listed())
    if (obstacle.kind == ObstacleKind::house) walls.push_back(obstacle);
  REQUIRE(walls.size() >= 8);
  REQUIRE(walls.size() % 4 == 0);
  std::map<std::pair<int, int>, int> sizes_dm;
  for (std::size_t i = 0; i < walls.size(); i += 4) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Obstacle &wall = walls[i + k], &next = walls[i + (k + 1) % 4];
      CHECK(glm::distance(wall.to_m, next.from_m) < 1e-6);
      CHECK(std::abs(glm::dot(wall.to_m - wall.from_m, next.to_m - next.from_m)) < 1e-3);
      CHECK(wall.high_m - wall.low_m > 1e5);
      CHECK(wall.run != next.run);
    }
    const auto length_dm = [&](std::size_t k) {
      return static_cast<int>(std::lround(10.0 * glm::distance(walls[i + k].from_m, walls[i + k].to_m)));
    };
    ++sizes_dm[{length_dm(0), length_dm(1)}];
    const Vec2 middle = 0.5 * (walls[i].from_m + walls[i + 2].from_m);
    CHECK(terrain.nearest(middle).outside_m > 40.0);
  }
  // Sizes of a farm's dwelling, barn and shed; of a church's nave and tower.
  CHECK(sizes_dm.at({120, 80}) == sizes_dm.at({260, 110}));
  CHECK(sizes_dm.at({120, 80}) == sizes_dm.at({90, 60}));
  CHECK(sizes_dm.size() == (sizes_dm.contains({220, 100}) ? 5 : 3));
}

TEST_CASE("bushes give way and trees do not and both are as thick as their kind and size") {
  int bushes = 0;
  for (const Obstacle& obstacle : motorway_obstacles().listed()) {
    if (obstacle.kind == ObstacleKind::tree) {
      CHECK(obstacle.yielding_kg == 0.0);
      CHECK(obstacle.radius_m >= 0.16 * 0.75);
      CHECK(obstacle.radius_m <= 0.32 * 1.2);
    } else if (obstacle.kind == ObstacleKind::bush) {
      ++bushes;
      CHECK(obstacle.yielding_kg == 40.0);
      CHECK(obstacle.radius_m >= 0.8 * 0.75);
      CHECK(obstacle.radius_m <= 0.8 * 1.2);
    }
  }
  CHECK(bushes > 100);
}

TEST_CASE("the same stem is found from wherever one looks") {
  int stems = 0;
  for (double s = 100.0; s < 6000.0; s += 200.0)
    for (const double t : {-160.0, 160.0}) {
      const Vec2 p = on_motorway(s, t), q = p + Vec2(3.0, -2.0);
      const auto from_p = motorway_obstacles().near(p, 6.0), from_q = motorway_obstacles().near(q, 12.0);
      for (const Obstacle& stem : from_p) {
        if ((stem.run & 0x8000'0000u) == 0) continue;
        ++stems;
        CHECK(stem.radius_m >= 0.10);
        CHECK(stem.radius_m <= 0.20);
        CHECK(glm::distance(stem.from_m, p) <= 6.0);
        CHECK(std::ranges::count_if(from_q, [&](const Obstacle& o) {
                return o.run == stem.run && o.from_m == stem.from_m && o.radius_m == stem.radius_m;
              }) == 1);
      }
    }
  CHECK(stems > 20);
}

TEST_CASE("a rail that goes on as another one has no end to run into") {
  struct End {
    Vec2 at, outwards;
  };
  std::vector<End> open;
  std::size_t closed = 0;
  std::map<std::uint32_t, std::pair<Obstacle, Obstacle>> runs;
  for (const Obstacle& obstacle : motorway_obstacles().listed()) {
    if (obstacle.from_m == obstacle.to_m || obstacle.kind == ObstacleKind::house) continue;
    const auto [run, is_new] = runs.try_emplace(obstacle.run, obstacle, obstacle);
    if (!is_new) run->second.second = obstacle;
  }
  for (const auto& [run, ends] : runs) {
    const auto& [first, last] = ends;
    if (first.open_from) open.push_back({first.from_m, glm::normalize(first.from_m - first.to_m)});
    if (last.open_to) open.push_back({last.to_m, glm::normalize(last.to_m - last.from_m)});
    closed += !first.open_from + !last.open_to;
  }
  CHECK(closed > 0);
  CHECK(open.size() > 2);
  for (std::size_t i = 0; i < open.size(); ++i)
    for (std::size_t k = i + 1; k < open.size(); ++k)
      CHECK_FALSE(
          (glm::distance(open[i].at, open[k].at) < 0.75 && glm::dot(open[i].outwards, open[k].outwards) < -0.9));
}

TEST_CASE("a thing that is gone is left out of what is near, and what stands beside it is not") {
  const Obstacles& obstacles = motorway_obstacles();
  std::size_t things = 0;
  for (const Obstacle& obstacle : obstacles.listed()) {
    if (obstacle.kind != ObstacleKind::gantry_leg && obstacle.kind != ObstacleKind::tree) continue;
    REQUIRE(obstacle.thing > 0);
    REQUIRE(obstacle.thing <= obstacles.things());
    if (obstacle.kind == ObstacleKind::tree) CHECK(obstacles.thing_at(obstacle.from_m) == obstacle.thing);
    if (++things % 40 != 0) continue;
    const std::vector<std::uint32_t> gone{obstacle.thing};
    const auto all = obstacles.near(obstacle.from_m, 30.0), left = obstacles.near(obstacle.from_m, 30.0, gone);
    const auto is_it = [&](const Obstacle& one) { return one.thing == obstacle.thing; };
    const auto its = std::ranges::count_if(all, is_it);
    CHECK(its == (obstacle.kind == ObstacleKind::tree ? 1 : 3));
    CHECK(std::ranges::count_if(left, is_it) == 0);
    CHECK(all.size() - left.size() == static_cast<std::size_t>(its));
  }
  CHECK(things > 100);
  for (const double x_m : {std::nan(""), 1e300, 0.5}) CHECK(obstacles.thing_at({x_m, 1e6}) == 0);
}

TEST_CASE(
    "noise walls, tunnels and houses hide what is behind them to their height, and rails, trees and posts nothing") {
  const Obstacles& all = motorway_obstacles();
  std::map<ObstacleKind, int> hiding, looked_at;
  for (const Obstacle& obstacle : all.listed()) {
    const Vec2 along = obstacle.to_m - obstacle.from_m, middle = 0.5 * (obstacle.from_m + obstacle.to_m);
    const double length_m = glm::length(along);
    // A short line across it at the height of eyes.
    const Vec2 across = length_m > 0.0 ? Vec2(-along.y, along.x) / length_m : Vec2(1.0, 0.0);
    const double up_m = (obstacle.low_m > -100.0 ? obstacle.low_m : 0.0) + 1.2;
    const bool hides = all.walls().hide(Vec3(middle - 0.01 * across, up_m), Vec3(middle + 0.01 * across, up_m));
    ++looked_at[obstacle.kind];
    hiding[obstacle.kind] += hides ? 1 : 0;
  }
  for (const ObstacleKind kind :
       {ObstacleKind::noise_wall, ObstacleKind::tunnel_wall, ObstacleKind::portal, ObstacleKind::house}) {
    CAPTURE(name_of(kind));
    REQUIRE(looked_at[kind] > 0);
    CHECK(hiding[kind] == looked_at[kind]);
  }
  for (const ObstacleKind kind :
       {ObstacleKind::guard_rail, ObstacleKind::parapet, ObstacleKind::tree, ObstacleKind::gantry_leg}) {
    CAPTURE(name_of(kind));
    REQUIRE(looked_at[kind] > 0);
    CHECK(hiding[kind] == 0);
  }
  for (const Obstacle& obstacle : all.listed()) {
    if (obstacle.kind != ObstacleKind::noise_wall) continue;
    const Vec2 along = glm::normalize(obstacle.to_m - obstacle.from_m), across(-along.y, along.x),
               middle = 0.5 * (obstacle.from_m + obstacle.to_m);
    CHECK_FALSE(
        all.walls().hide(Vec3(middle - across, obstacle.high_m + 0.1), Vec3(middle + across, obstacle.high_m + 0.1)));
  }
}

}  // namespace septet::roadside

#include "engine/roadside/street_lighting.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/town.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/road/third_party_road.hpp"

namespace septet::roadside {
namespace {

using road::third_party_road;

road::RoadNetwork shipped(const std::string& path) {
  std::ifstream file(source_folder() + "/" + path);
  REQUIRE(file);
  return road::read_or_fail({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
}

/// Light of one lane over one stretch, on the grid of EN 13201-3: three rows across the lane, places at most 3 m apart
/// along it.
struct LaneLight {
  double mean_lux = 0.0, least_lux = 1e9;
  int places = 0;
};

struct TownLight {
  int lanes = 0, dim = 0, uneven = 0;
  double dimmest_lux = 1e9, least_uniformity = 1.0;
};

TownLight measured(const RoadShape& roads, const std::vector<StreetLamp>& lamps, bool junctions) {
  const LampLight light(lamps);
  TownLight town;
  for (road::RoadIndex index = 0; index < roads.network().roads.size(); ++index) {
    const road::Road& road = roads.road(index);
    if ((road.junction != road::no_index) != junctions) continue;
    for (std::size_t n = 0; n < road.sections.size(); ++n) {
      const road::LaneSection& section = road.sections[n];
      const double begin = section.s_m, end = n + 1 < road.sections.size() ? road.sections[n + 1].s_m : road.length_m;
      const int steps = std::max(1, static_cast<int>(std::ceil((end - begin) / 3.0)));
      for (int lane = -section.right_count; lane <= section.left_count; ++lane) {
        if (lane == 0 || !road::is_drivable(section.lane(lane).type)) continue;
        LaneLight here;
        for (int i = 0; i < steps; ++i) {
          const double s = begin + (end - begin) * (i + 0.5) / steps;
          if (!is_in_town(roads.network(), index, s) || roads.structure_at(index, s, road::RoadStructure::Kind::tunnel))
            continue;
          const road::LaneBorders borders = road::lane_borders(road, section, lane, s);
          if (borders.width_m() < 1.0) continue;
          for (const double share : {1.0 / 6.0, 0.5, 5.0 / 6.0}) {
            const double lux =
                light.lux(roads.at(index, s, std::lerp(borders.inner_t_m, borders.outer_t_m, share)).position_m);
            here.mean_lux += lux;
            here.least_lux = std::min(here.least_lux, lux);
            ++here.places;
          }
        }
        if (here.places < 6) continue;  // Shorter than two places along it.
        here.mean_lux /= here.places;
        ++town.lanes;
        const double uniformity = here.least_lux / here.mean_lux;
        town.dim += here.mean_lux < 7.5;
        town.uneven += uniformity < 0.35;
        town.dimmest_lux = std::min(town.dimmest_lux, here.mean_lux);
        town.least_uniformity = std::min(town.least_uniformity, uniformity);
      }
    }
  }
  return town;
}

int too_near(const std::vector<StreetLamp>& lamps) {
  int count = 0;
  for (std::size_t i = 0; i < lamps.size(); ++i)
    count += std::ranges::any_of(lamps, [&](const StreetLamp& other) {
      return &other != &lamps[i] &&
             glm::distance(Vec2(other.world_from_lamp.position_m), Vec2(lamps[i].world_from_lamp.position_m)) < 8.0;
    });
  return count;
}

void check_lit(const std::string& name, const road::RoadNetwork& network) {
  CAPTURE(name);
  const RoadShape roads(network, 0.0);
  const std::vector<StreetLamp> lamps = street_lamps(roads);
  CHECK(lamps.size() > 10);
  CHECK(too_near(lamps) == 0);
  for (const bool junctions : {false, true}) {
    const TownLight town = measured(roads, lamps, junctions);
    CAPTURE(junctions);
    CAPTURE(town.lanes);
    CAPTURE(town.dimmest_lux);
    CAPTURE(town.least_uniformity);
    CHECK(town.lanes > 0);
    CHECK(town.dim == 0);
    CHECK(town.uneven == 0);
  }
}

}  // namespace

TEST_CASE(
    "street lamps light every lane of a town, in junctions too, with 7.5 lx in the mean and 0.35 of it at least") {
  check_lit("first lesson", shipped("scenarios/first-lesson/first-lesson.xodr"));
  for (const char* name : {"fabriksgatan", "multi_intersections"}) check_lit(name, third_party_road(name));
  for (const char* name : {"Town01", "Town03"}) {
    std::ifstream file(conformance_data("towns") / (std::string(name) + ".xodr"));
    check_lit(name, road::read_or_fail({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()}));
  }
}

}  // namespace septet::roadside

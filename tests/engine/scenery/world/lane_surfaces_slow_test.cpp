#include "engine/scenery/world/lane_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/barrier_lines.hpp"
#include "engine/roadside/obstacles.hpp"
#include "tests/engine/scenery/world/drawn_world.hpp"
#include "tests/relative.hpp"

namespace septet::scenery {
namespace {

scene::Store built(const road::RoadNetwork& network) {
  scene::Store store;
  scene::SceneBuilder builder(store);
  build_road_world(builder, network, 3, bare);
  return store;
}

/// Distance of the nearest drawn surface at places of all lanes from the wheels' surface; a metre if none is drawn.
struct Apart {
  int places = 0, wrong = 0;
  double most_m = 0.0;
};
Apart apart(const road::RoadNetwork& network, double step_m, double tolerated_m) {
  const DrawnHeights heights(drawn_triangles(built(network), "pavement"));
  Apart result;
  for (road::RoadIndex index = 0; index < network.roads.size(); ++index) {
    const road::Road& road = network.roads[index];
    for (double s = 0.37; s < road.length_m; s += step_m) {
      const road::LaneSection& section = road::section_at(road, s);
      for (const road::Lane& lane : section.lanes) {
        const road::LaneBorders borders = road::lane_borders(road, section, lane.id, s);
        if (lane.id == 0 || borders.width_m() < 0.2) continue;
        for (const double share : {0.06, 0.5, 0.94}) {
          const Vec3 p =
              road::evaluate(network, {index, s, std::lerp(borders.inner_t_m, borders.outer_t_m, share)}).position_m;
          // Both surfaces are found where another road's lanes overlap these.
          if (road::roads_holding(network, Vec2(p)).size() > 1 && !road::is_drivable(lane.type)) continue;
          double least_m = 1.0;
          for (const double z : heights.at(Vec2(p))) least_m = std::min(least_m, std::abs(z - p.z));
          ++result.places;
          result.most_m = std::max(result.most_m, least_m);
          result.wrong += least_m > tolerated_m;
        }
      }
    }
  }
  return result;
}

std::string with_kerb() {
  return road::SmallRoad{.sections = "<laneSection s=\"0\"><left>" + road::lane(1, 3.0) + "</left><center>" +
                                     road::lane(0, 0) + "</center><right>" + road::lane(-1, 3.5) +
                                     road::lane(-2, 2.0,
                                                "<height sOffset=\"0\" inner=\"0.12\" outer=\"0.15\"/>"
                                                "<height sOffset=\"40\" inner=\"0.02\" outer=\"0.12\"/>"
                                                "<height sOffset=\"44\" inner=\"0.12\" outer=\"0.15\"/>",
                                                "sidewalk") +
                                     "</right></laneSection>"}
      .xml();
}

}  // namespace

TEST_CASE("a road is drawn where wheels find it, with its kerbs and where they are lowered") {
  const Apart kerb = apart(road::read_or_fail(with_kerb()), 0.9, 0.004);
  CHECK(kerb.places > 500);
  CHECK(kerb.most_m < 0.004);
  const Apart town = apart(third_party_road("fabriksgatan"), 2.3, 0.02);
  CHECK(town.places > 2000);
  // The chord of a bend lies beside its edge: a narrow strip of a kerb is found on the other side of it.
  CHECK(town.wrong * 400 < town.places);
}

TEST_CASE("a kerb has a face towards the road, upright and as high as its step") {
  double face_m2 = 0.0;
  int turned_away = 0;
  for (const DrawnTriangle& triangle : drawn_triangles(built(road::read_or_fail(with_kerb())), "pavement")) {
    const Vec3 across = triangle.across();
    if (std::abs(across.y) < 0.9 * glm::length(across)) continue;
    face_m2 += 0.5 * glm::length(across);
    turned_away += across.y < 0.0;  // The pavement is on the right: its face looks to the left.
  }
  CHECK(face_m2 == relative(96.0 * 0.12 + 4.0 * 0.02, 0.01));
  CHECK(turned_away == 0);
}

TEST_CASE("a lane is covered with what its type is of") {
  const auto covers = [](const std::string& type) {
    const std::string xml =
        road::SmallRoad{.sections = "<laneSection s=\"0\"><center>" + road::lane(0, 0) + "</center><right>" +
                                    road::lane(-1, 3.5) + road::lane(-2, 2.5, "", type) + "</right></laneSection>"}
            .xml();
    std::map<std::string, double> m2;
    for (const DrawnTriangle& triangle : drawn_triangles(built(road::read_or_fail(xml)), "pavement"))
      m2[triangle.material] += 0.5 * glm::length(triangle.across());
    for (auto& [material, area] : m2) area = std::round(area);
    return m2;
  };
  using Covers = std::map<std::string, double>;
  CHECK(covers("driving") == Covers{{"world/asphalt", 600.0}});
  CHECK(covers("border") == Covers{{"world/asphalt", 600.0}});
  CHECK(covers("none") == Covers{{"world/asphalt", 350.0}, {"world/verge", 250.0}});
  CHECK(covers("sidewalk") == Covers{{"world/asphalt", 350.0}, {"world/kerb stone", 14.0}, {"world/paving", 236.0}});
  CHECK(covers("biking") == Covers{{"world/asphalt", 350.0}, {"world/cycle path", 250.0}});
  CHECK(covers("parking") == Covers{{"world/asphalt", 350.0}, {"world/asphalt old", 250.0}});
  CHECK(covers("rail") == Covers{{"world/asphalt", 350.0}, {"world/gravel", 250.0}});
}

TEST_CASE("marker posts stand along roads through land, and neither in towns nor in junctions") {
  const auto posts = [](const road::RoadNetwork& network) {
    const roadside::Obstacles obstacles(network, 3, 0.0);
    return std::ranges::count_if(obstacles.listed(),
                                 [](const Obstacle& thing) { return thing.kind == ObstacleKind::marker_post; });
  };
  CHECK(posts(road::read_or_fail(road::SmallRoad{}.xml())) == 4);
  CHECK(posts(road::read_or_fail(with_kerb())) == 0);
  CHECK(posts(third_party_road("fabriksgatan")) == 0);
}

TEST_CASE("grass lies on no lane that is driven, in a junction neither") {
  const road::RoadNetwork network = third_party_road("multi_intersections");
  int over = 0, corners = 0;
  for (const DrawnTriangle& triangle : drawn_triangles(built(network), "verge")) {
    const Vec3 middle = (triangle.corners_m[0] + triangle.corners_m[1] + triangle.corners_m[2]) / 3.0;
    if (triangle.material != "world/verge") continue;  // Islands between lanes are paved.
    ++corners;
    for (const road::Location& location : road::roads_holding(network, Vec2(middle))) {
      const road::Road& road = network.roads[location.position.road];
      const road::LaneType type =
          road::lane_type(network, location.position.road, location.lanes.lane_any_type, location.position.s_m);
      if (!road::is_drivable(type)) continue;
      // Excludes the beginning of the strip, close to the lane's edge.
      const road::RoadExtent extent = road::road_extent(road, location.position.s_m);
      const double inside = std::min(extent.left_t_m - location.position.t_m, location.position.t_m - extent.right_t_m);
      over += inside > 0.15 && middle.z > road::evaluate(network, location.position).position_m.z - 0.005;
    }
  }
  CHECK(corners > 500);
  CHECK(over == 0);
}

}  // namespace septet::scenery

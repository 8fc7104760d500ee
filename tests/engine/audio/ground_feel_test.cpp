#include "engine/audio/ground_feel.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <doctest/doctest.h>

#include "engine/road/lane_geometry.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/relative.hpp"

namespace septet::audio {
namespace {

/// The driver's car with the middle of its front axle there, along the road.
Snapshot car_at(const road::RoadNetwork& roads, const road::RoadPosition& front, double wheelbase_m) {
  const road::RoadPoint point = road::evaluate(roads, front);
  Snapshot snapshot;
  snapshot.driver_car.participant = 1;
  Participant own;
  own.id = 1;
  own.world_from_vehicle.orientation =
      Quat(std::cos(0.5 * point.heading_rad), 0.0, 0.0, std::sin(0.5 * point.heading_rad));
  own.world_from_vehicle.position_m =
      point.position_m - own.world_from_vehicle.orientation * Vec3(wheelbase_m, 0.0, 0.0);
  snapshot.participants = {own};
  return snapshot;
}

}  // namespace

TEST_CASE("a wheel over a solid line feels it, over a broken one where it is painted, and between lines nothing") {
  const road::RoadNetwork& roads = road::motorway();
  const road::RoadIndex index = 0;
  const road::Road& first = roads.roads[index];
  const double s_m = 0.5 * first.length_m;
  const auto& section = road::section_at(first, s_m);
  std::optional<road::RoadPosition> place;
  int solid = 0, broken = 0;
  for (const road::Lane& lane : section.lanes) {
    if (lane.id == 0 || !road::is_drivable(lane.type)) continue;
    const auto borders = road::lane_borders(first, section, lane.id, s_m);
    CHECK_FALSE(feel_ground(roads, car_at(roads, {index, s_m, borders.centre_t_m()}, 2.8), place, 2.8).on_line);
    const road::RoadMark* mark = road::road_mark_at(roads, index, lane.id, s_m);
    if (!mark || mark->lines.empty()) continue;
    // The left wheel stands 0.76 m to the left of the middle.
    int on = 0, looked = 0;
    for (double ahead_m = 0.0; ahead_m < 36.0; ahead_m += 0.5, ++looked)
      on +=
          feel_ground(roads, car_at(roads, {index, s_m + ahead_m, borders.outer_t_m - 0.76}, 2.8), place, 2.8).on_line;
    if (mark->type == road::RoadMarkType::solid) {
      ++solid;
      CHECK(on == looked);
    } else if (mark->type == road::RoadMarkType::broken) {
      ++broken;
      CHECK(on > 0);
      CHECK(on < looked);
    }
  }
  CHECK(solid + broken > 0);
}

TEST_CASE("beside the road the ground is a meadow's, and a car that is nowhere feels a good road") {
  const road::RoadNetwork& roads = road::motorway();
  std::optional<road::RoadPosition> place;
  const double edge_m = road::road_extent(roads.roads[0], 500.0).left_t_m;
  CHECK(feel_ground(roads, car_at(roads, {0, 500.0, edge_m + 8.0}, 2.8), place, 2.8).unevenness_m3 == class_e_m3);
  Snapshot nowhere = car_at(roads, {0, 500.0, 0.0}, 2.8);
  nowhere.participants[0].world_from_vehicle.position_m.x = std::numeric_limits<double>::quiet_NaN();
  CHECK(feel_ground(roads, nowhere, place, 2.8).unevenness_m3 == class_a_m3);
  CHECK(feel_ground({}, Snapshot{}, place, 2.8).unevenness_m3 == class_a_m3);
}

TEST_CASE("surfaces are as uneven as their words say, whoever wrote the file") {
  CHECK(unevenness_m3("asphalt") == class_a_m3);
  CHECK(unevenness_m3("Cobblestone") == class_d_m3);
  CHECK(unevenness_m3("gravel") == class_d_m3);
  CHECK(unevenness_m3("CONCRETE") == class_b_m3);
  CHECK(unevenness_m3("\xff\xfe") == class_a_m3);
  // At 20 m/s on a good road, 8 to 35 Hz: 2 pi 0.1 (16e-6 20 27)^(1/2).
  CHECK(ground_velocity_mps(class_a_m3, 20.0, 8.0, 35.0) == relative(0.0584, 0.01));
}

}  // namespace septet::audio

// Conflicts on the road of first-lesson where others may have right of way, and their times.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "engine/road/opendrive_reader.hpp"
#include "engine/road/turn.hpp"
#include "engine/traffic/corridor.hpp"
#include "engine/traffic/yield_line.hpp"
#include "tests/relative.hpp"
#include "tests/shipped_files.hpp"

namespace septet::traffic {
namespace {

using Kind = YieldLine::Kind;

const road::RoadNetwork& lesson_road() {
  static const road::RoadNetwork network =
      *road::read_opendrive(shipped_text("scenarios/first-lesson/first-lesson.xodr"), "first-lesson.xodr");
  return network;
}

road::RoadIndex road_of(std::string_view id) { return *road::find_road(lesson_road(), id); }

Participant somebody(std::string_view model, ParticipantId id, const Vec2& at, double heading_rad, double mps) {
  Participant participant;
  participant.id = id;
  participant.model = *find_vehicle_model(model);
  participant.world_from_vehicle = {Vec3(at, 12.0), orientation_from_angles(heading_rad, 0.0, 0.0)};
  participant.velocity_mps = participant.world_from_vehicle.orientation * Vec3(mps, 0.0, 0.0);
  return participant;
}

struct Place {
  Vec2 at;
  double heading_rad;
};
Place in_lane(std::string_view road, int lane, double s_m) {
  const road::LanePoint point = road::evaluate_lane(lesson_road(), {road_of(road), lane, s_m, 0.0});
  return {Vec2(point.road.position_m), point.driving_heading_rad};
}

/// Conflict of a car before the roundabout with a vehicle in its ring.
std::optional<Conflict> at_roundabout(std::string_view road, double s_m, double mps, double turns_radps) {
  const road::RoadNetwork& network = lesson_road();
  const double end_m = network.roads[road_of("3")].length_m;
  const Place own = in_lane("3", -1, end_m - 5.0), other = in_lane(road, -1, s_m);
  Participant ring = somebody("hatchback", 5, other.at, other.heading_rad, mps);
  ring.angular_velocity_radps.z = turns_radps;
  const std::vector<Participant> all{somebody("volvo-s80", 1, own.at, own.heading_rad, 5.0), ring};
  const auto way = way_beyond(network, Kind::give_way, {road_of("3"), -1, end_m - 1.0, 0.0});
  return first_conflict(Kind::give_way, way, all, all.front());
}

}  // namespace

TEST_CASE("lights, give-way signs and crossings are lines for those whom they are for") {
  const auto lines = yield_lines(lesson_road());
  const auto count = [&](Kind kind) { return std::ranges::count(lines, kind, &YieldLine::kind); };
  CHECK(count(Kind::light) == 4);
  CHECK(count(Kind::give_way) == 4);
  CHECK(count(Kind::crossing) == 2);
  const auto light = std::ranges::find_if(
      lines, [](const YieldLine& line) { return line.kind == Kind::light && line.road == road_of("2"); });
  REQUIRE(light != lines.end());
  CHECK(light->along_s);
  CHECK(light->s_m == doctest::Approx(light->signal_s_m - 3.0));  // Its stop line.
  CHECK(yield_lines(road::RoadNetwork{}).empty());
}

TEST_CASE("who drives round the ring comes to the way of who would enter, and who leaves it behind does not") {
  const auto comes = at_roundabout("54", 5.0, 6.0, 6.0 / 18.5);
  REQUIRE(comes.has_value());
  CHECK(comes->with == 5);
  CHECK(comes->in_s > 1.0);
  CHECK(comes->in_s < 7.0);
  const auto near = at_roundabout("51", 12.0, 6.0, 6.0 / 18.5);
  REQUIRE(near.has_value());
  CHECK(near->in_s < 1.0);
  CHECK_FALSE(at_roundabout("52", 14.0, 6.0, 0.0).has_value());
  CHECK_FALSE(at_roundabout("54", 5.0, 0.0, 0.0).has_value());
}

TEST_CASE("a walker counts while he is on the way over a crossing or comes to it, and vehicles do not") {
  const road::RoadNetwork& network = lesson_road();
  const Place own = in_lane("2", -1, 230.0), line = in_lane("2", -1, 250.0);
  const auto way = way_beyond(network, Kind::crossing, {road_of("2"), -1, 247.0, 0.0});
  const Vec2 left(-std::sin(line.heading_rad), std::cos(line.heading_rad));
  const double across = line.heading_rad + 0.5 * std::numbers::pi;
  const auto with = [&](std::string_view model, double offset_m, double mps) {
    const std::vector<Participant> all{somebody("volvo-s80", 1, own.at, own.heading_rad, 10.0),
                                       somebody(model, 7, line.at + offset_m * left, across, mps)};
    return first_conflict(Kind::crossing, way, all, all.front());
  };
  REQUIRE(with("pedestrian", 0.0, 1.3).has_value());
  CHECK(with("pedestrian", 0.0, 1.3)->in_s == 0.0);
  CHECK(with("pedestrian", -5.5, 1.3)->in_s == relative(3.0, 0.1));
  CHECK_FALSE(with("pedestrian", 2.5, 1.3).has_value());  // Is over it, and goes on.
  CHECK_FALSE(with("hatchback", 0.0, 1.3).has_value());
}

TEST_CASE("the way out of a roundabout is a turn to the right, its ring and its way in are none") {
  const road::RoadNetwork& network = lesson_road();
  const auto turn = [&](std::string_view id) { return road::turn_through(network, road_of(id), -1, true); };
  for (const char* out : {"71", "72", "73", "74"}) CHECK(turn(out) == -1);
  for (const char* none : {"51", "52", "53", "54", "61", "62", "63", "64", "2", "81"}) CHECK(turn(none) == 0);
  CHECK(turn("82") == -1);
  CHECK(turn("83") == 1);
}

TEST_CASE("the course is the first connection at each fork: over the lights, and out at the second way") {
  const Corridor corridor = build_corridor(lesson_road(), {road_of("1"), -1, 10.0, 0.0});
  std::vector<std::string> roads;
  for (const CorridorPiece& piece : corridor.pieces) roads.push_back(lesson_road().roads[piece.road].id);
  CHECK(roads == std::vector<std::string>{"1", "2", "81", "3", "61", "41", "52", "42", "73", "4"});
}

}  // namespace septet::traffic

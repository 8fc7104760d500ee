#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "engine/driver/course.hpp"
#include "engine/driver/driver_parameters.hpp"
#include "engine/driver/pedals.hpp"
#include "engine/driver/simulated_driver.hpp"
#include "engine/sight/walls.hpp"
#include "engine/traffic/corridor.hpp"
#include "engine/traffic/network/approach_view.hpp"
#include "tests/engine/traffic/crossing_road.hpp"

namespace septet::driver {
namespace {

constexpr double glance_s = 0.05, comes_mps = 12.0, sign_at_m = 198.0;

/// A house between the arms of east and north, up to so far before the middle of the crossing, by its two sides there.
constexpr std::uint32_t house = 1;
std::vector<traffic::ApproachView> hidden_by_house(const road::RoadNetwork& network, double from_middle_m,
                                                   std::span<const std::uint32_t> gone = {}) {
  const Vec2 corner(from_middle_m, 6.0);
  const sight::Walls walls(
      {{{90.0, 6.0}, corner, -1.0, 8.0, house}, {corner, {from_middle_m, 90.0}, -1.0, 8.0, house}});
  return traffic::approach_views(network, walls, gone);
}

struct Approach {
  double line_mps = 0.0;          ///< As the line is passed.
  double most_needed_mps2 = 0.0;  ///< Braking that stopping at the line would have taken, until 2 m before it.
  bool passes = false;
};

/// A drive from the arm in the east, where one gives way, into a left turn; nobody else is there.
Approach approach(const road::RoadNetwork& network, std::span<const traffic::ApproachView> views,
                  std::span<const Participant> others = {}) {
  const DriverParameters driver = *find_driver("experienced");
  const auto east = road::find_road(network, "east");
  REQUIRE(east.has_value());
  const traffic::Corridor corridor = traffic::build_corridor(network, {*east, -1, 50.0, 0.0});
  CourseState course = read_course(network, corridor, views);
  REQUIRE(course.lines.size() == 1);
  Snapshot snapshot;
  Participant self;
  self.id = snapshot.driver_car.participant;
  OwnPlace own;
  own.lane = 1, own.x_m = 60.0, own.speed_mps = comes_mps, own.front_m = 3.0;
  std::vector<Participant> around{self};
  around.insert(around.end(), others.begin(), others.end());
  Random random(1);
  Approach made;
  for (double t = 0.0; t < 60.0 && !made.passes; t += glance_s) {
    const road::LanePoint place = road::evaluate_lane(network, traffic::position_at(corridor, own.x_m, own.lane));
    self.world_from_vehicle = road::world_from_lane(place);
    around.front() = self;
    look_at_course(course, driver, network, corridor, snapshot, around, own, t, glance_s, random);
    const double wish = std::min(comes_mps, course.speed_mps);
    const double a = wished_acceleration_mps2(driver.speed, own.speed_mps, wish, line_ahead(course, own, driver.speed));
    own.speed_mps = std::max(0.0, own.speed_mps + a * glance_s);
    own.x_m += own.speed_mps * glance_s;
    const double left_m = sign_at_m - own.x_m - own.front_m;
    made.passes = left_m < 0.0;
    made.line_mps = own.speed_mps;
    if (left_m > traffic::at_stop_line_m)
      made.most_needed_mps2 = std::max(made.most_needed_mps2, 0.5 * own.speed_mps * own.speed_mps / left_m);
  }
  return made;
}

}  // namespace

TEST_CASE("a driver comes to a hidden give-way line so that he can stop there, and passes it once it is in view") {
  const road::RoadNetwork network = traffic::crossing(false, traffic::Posted::signs);
  const Approach open = approach(network, {}), at_line = approach(network, hidden_by_house(network, 10.0)),
                 at_5_m = approach(network, hidden_by_house(network, 20.0));
  CHECK(open.passes);
  CHECK(at_line.passes);
  CHECK(at_5_m.passes);
  CHECK(at_line.line_mps < open.line_mps - 1.5);
  CHECK(at_line.most_needed_mps2 < 4.0);
  CHECK(open.most_needed_mps2 > 6.0);
  CHECK(at_5_m.line_mps > at_line.line_mps + 0.3);
}

TEST_CASE("a house that is gone slows no driver, and one on his way learns that it is gone, or back") {
  const road::RoadNetwork network = traffic::crossing(false, traffic::Posted::signs);
  const auto standing = hidden_by_house(network, 10.0), gone = hidden_by_house(network, 10.0, std::span(&house, 1));
  CHECK(approach(network, gone).line_mps == approach(network, {}).line_mps);
  SimulatedDriver driver(*find_driver("experienced"), 1);
  const auto seen_from_m = [&](const std::vector<traffic::ApproachView>& views) {
    learn_views(driver, network, views);
    return driver.course.lines.empty() ? -1.0 : driver.course.lines[0].view->seen_from_m;
  };
  CHECK(seen_from_m(standing) == -1.0);  // He is on no road yet.
  const auto east = road::find_road(network, "east");
  REQUIRE(east.has_value());
  driver.corridor = traffic::build_corridor(network, {*east, -1, 50.0, 0.0});
  CHECK(seen_from_m(standing) < 10.0);
  CHECK(seen_from_m(gone) > traffic::looks_before_m.front());
  CHECK(seen_from_m(standing) < 10.0);
}

TEST_CASE("a driver comes to a line at which a van hides the junction so that he can stop there, and past a car not") {
  const road::RoadNetwork network = traffic::crossing(false, traffic::Posted::signs);
  const auto views = traffic::approach_views(network, {});
  const auto past = [&](const char* model) {
    Participant parked;
    parked.id = 7;
    parked.model = *find_vehicle_model(model);
    parked.world_from_vehicle.position_m = Vec3(16.0, 5.2, 0.0);
    return approach(network, views, std::span(&parked, 1));
  };
  const Approach open = approach(network, views), van = past("van"), car = past("volvo-s80");
  CHECK(van.passes);
  CHECK(van.line_mps < open.line_mps - 1.5);
  CHECK(van.most_needed_mps2 < 4.0);
  CHECK(car.line_mps == open.line_mps);
}

}  // namespace septet::driver

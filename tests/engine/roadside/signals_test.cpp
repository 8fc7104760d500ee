#include "engine/roadside/signals.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/obstacles.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/engine/road/third_party_road.hpp"

namespace septet::roadside {
namespace {

road::RoadNetwork with_signals(const std::string& signals) {
  return road::read_or_fail(
      road::replaced(road::SmallRoad{}.xml(), "</lanes>", "</lanes><signals>" + signals + "</signals>"));
}

std::string signal(const std::string& type, double s, double t, const std::string& more) {
  return "<signal id=\"1\" type=\"" + type + "\" s=\"" + std::to_string(s) + "\" t=\"" + std::to_string(t) + "\" " +
         more + "/>";
}

}  // namespace

TEST_CASE("a signal is a board, a light, a display or paint by its type, and of no type nothing") {
  const auto form = [](const std::string& type, bool dynamic, double height_m, const std::string& name) {
    road::Signal signal;
    signal.type = type;
    signal.dynamic = dynamic;
    signal.height_m = height_m;
    signal.name = name;
    return form_of(signal);
  };
  CHECK(form("274", false, 0.6, "") == SignalForm::board);
  CHECK(form("274", true, 0.6, "") == SignalForm::display);
  CHECK(form("274", false, 1.2, "speed_display") == SignalForm::display);
  CHECK(form("1000001", true, 3.2, "") == SignalForm::light);
  CHECK(form("1000002", true, 2.6, "") == SignalForm::pedestrian_light);
  CHECK(form("1000003", false, 0.01, "") == SignalForm::crossing);
  CHECK(form("294", false, 0.03, "") == SignalForm::stop_line);
  CHECK(form("-1", false, 0.03, "SgRMArrowLeft.flt") == SignalForm::arrow);
  CHECK(form("-1", false, 0.0, "") == SignalForm::none);
  CHECK(form("", false, 0.61, "de_274-50") == SignalForm::board);
}

TEST_CASE("signals at one place hang over one another") {
  const road::RoadNetwork network = road::third_party_road("multi_intersections");
  const RoadShape roads(network, 0.0);
  const std::vector<StandingSignal> all = standing_signals(roads);
  CHECK(std::ranges::count(all, SignalForm::light, &StandingSignal::form) == 34);
  CHECK(std::ranges::count(all, SignalForm::pedestrian_light, &StandingSignal::form) == 34);
  CHECK(std::ranges::count(all, SignalForm::board, &StandingSignal::form) == 21);
  int overlapping = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Vec3 x(1, 0, 0);
      if (glm::distance(all[i].world_from_signal.position_m, all[k].world_from_signal.position_m) > 0.3 ||
          glm::dot(all[i].world_from_signal.orientation * x, all[k].world_from_signal.orientation * x) < 0.5)
        continue;
      overlapping += all[i].bottom_m < all[k].bottom_m + all[k].height_m - 1e-9 &&
                     all[k].bottom_m < all[i].bottom_m + all[i].height_m - 1e-9;
    }
  CHECK(overlapping == 0);
}

TEST_CASE("who reads a signal drives towards its face") {
  const road::RoadNetwork network =
      with_signals(signal("206", 50, -5, "orientation=\"+\"") + signal("206", 50, 5, "orientation=\"-\"") +
                   signal("206", 60, 5, "orientation=\"none\"") +
                   signal("206", 70, -5, "orientation=\"+\" hOffset=\"43.9822971503\""));
  const RoadShape roads(network, 0.0);
  const auto all = standing_signals(roads);
  REQUIRE(all.size() == 4);
  std::vector<double> along;
  for (const StandingSignal& standing : all)
    along.push_back(std::round(1e3 * (standing.world_from_signal.orientation * Vec3(1, 0, 0)).x) / 1e3);
  CHECK(along == std::vector<double>{1.0, -1.0, -1.0, 1.0});
}

TEST_CASE("a signal's post is run against, and over a lane that is driven there is none") {
  const road::RoadNetwork network =
      with_signals(signal("206", 50, -5, "") + signal("1000001", 50, -1.5, "dynamic=\"yes\" zOffset=\"5\""));
  const Obstacles obstacles(network, 1, 0.0);
  std::vector<Vec2> posts;
  for (const Obstacle& obstacle : obstacles.listed())
    if (obstacle.kind == ObstacleKind::post) posts.push_back(obstacle.from_m);
  REQUIRE(posts.size() == 1);
  CHECK(glm::distance(posts[0], Vec2(50.0, -5.0)) < 1e-6);
}

}  // namespace septet::roadside

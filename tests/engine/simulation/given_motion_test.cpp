/// The driver's car goes by a path or by an event data recorder's table.

#include "engine/simulation/given_motion.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "tests/relative.hpp"
#include "tests/why_not.hpp"

using namespace septet;
using namespace septet::simulation;

namespace {

constexpr double circle_m = 50.0, circle_mps = 14.0;

/// A circle at constant speed, a row each tenth of a second for 5 s.
std::string circle(bool with_heading) {
  std::string text = with_heading ? "time_s,x_m,y_m,heading_deg\n" : "time_s,x_m,y_m\n";
  for (int i = 0; i <= 50; ++i) {
    const double angle = 0.1 * i * circle_mps / circle_m;
    text += fmt::format("{:.1f},{:.9f},{:.9f}", 100.0 + 0.1 * i, circle_m * std::sin(angle),
                        circle_m * (1.0 - std::cos(angle)));
    text += with_heading ? fmt::format(",{:.9f}\n", angle * 180.0 / std::numbers::pi) : "\n";
  }
  return text;
}

GivenMotion read(const std::string& text) {
  auto motion = read_motion(text, "edr.csv");
  REQUIRE_MESSAGE(motion.has_value(), why_not(motion));
  return std::move(*motion);
}

std::string refusal(const std::string& text) {
  const auto motion = read_motion(text, "edr.csv");
  return motion ? "taken" : describe(motion.error());
}

bool says(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a path's cubic keeps to a circle within a millimetre and a tenth of a degree, between its rows too") {
  for (const bool with_heading : {true, false}) {
    CAPTURE(with_heading);
    const GivenMotion motion = read(circle(with_heading));
    double farthest_m = 0.0, most_turned_rad = 0.0;
    for (double t_s = 0.0; t_s <= 5.0; t_s += 1.0 / 120.0) {
      const PlanMotion now = motion_at(motion, t_s);
      const double angle = t_s * circle_mps / circle_m;
      const Vec2 right(circle_m * std::sin(angle), circle_m * (1.0 - std::cos(angle)));
      farthest_m = std::max(farthest_m, glm::distance(now.place_m, right));
      most_turned_rad = std::max(most_turned_rad, std::abs(now.heading_rad - angle));
      CHECK(glm::length(now.velocity_mps) == relative(circle_mps, 0.002));
    }
    CHECK(farthest_m < 1e-3);
    CHECK(most_turned_rad * 180.0 / std::numbers::pi < 0.1);
  }
}

TEST_CASE("a recorder's table is integrated to the distance of its speeds and to the heading of its yaw rates") {
  std::string text = "# five seconds before the contact\ntime_s,speed_kmh,yaw_rate_degps\n";
  double way_m = 0.0, turned_deg = 0.0;
  const auto speed_kmh = [](double t) { return 72.0 - 6.0 * t * t / 5.0; };
  const auto yaw_degps = [](double t) { return 4.0 * t; };
  for (int i = 0; i <= 10; ++i) {
    const double t = 0.5 * i;
    text += fmt::format("{},{},{}\n", t - 5.0, speed_kmh(t), yaw_degps(t));
    if (i == 0) continue;
    way_m += 0.5 * 0.5 * (speed_kmh(t) + speed_kmh(t - 0.5)) / 3.6;
    turned_deg += 0.5 * 0.5 * (yaw_degps(t) + yaw_degps(t - 0.5));
  }
  const GivenMotion motion = read(text);
  CHECK(motion.end_s() == 5.0);
  double driven_m = 0.0;
  Vec2 before{0.0};
  for (int tick = 1; tick <= 600; ++tick) {
    const PlanMotion now = motion_at(motion, tick / 120.0);
    driven_m += glm::distance(now.place_m, before);
    before = now.place_m;
  }
  CHECK(driven_m == relative(way_m, 1e-3));
  CHECK(motion_at(motion, 5.0).heading_rad * 180.0 / std::numbers::pi == relative(turned_deg, 1e-3));
}

TEST_CASE("rows that no tyre can bring about are named by their lines") {
  const std::string said = refusal("time_s,speed_kmh\n0,50\n0.1,50\n\n0.2,30\n0.3,29\n0.4,60\n");
  CHECK(says(said, "no tyre gives more than 1.1 g: line 5 (5.7 g), line 7 (8.8 g)"));
  CHECK(says(refusal("time_s,speed_mps,yaw_rate_radps\n0,20,0.1\n1,20,0.9\n"), "line 3 (1.8 g)"));
  CHECK(says(refusal("time_s,x_m,y_m\n0,0,0\n1,10,0\n2,20,0\n3,30,40\n"), "line 4"));
}

TEST_CASE("rows that a recorder's table lacks are named by the lines around them, and a path may have any times") {
  const std::string said = refusal("time_s,speed_kmh\n-5,50\n-4,50\n# lost\n-1,48\n0,47\n");
  CHECK(says(said, "edr.csv: rows are missing: 3 s from line 3 to line 5, where most rows follow after 1 s; add them"));
  CHECK(says(refusal("time_s,speed_kmh\n0,50\n0.5,50\n1.5,50\n"), "1 s from line 3 to line 4"));
  // The instant of the contact is often half an interval after the last row.
  CHECK(refusal("time_s,speed_kmh\n-2.5,50\n-1.5,50\n-0.5,48\n0,47\n") == "taken");
  CHECK(refusal("time_s,speed_kmh\n0,50\n600,50\n") == "taken");
  CHECK(refusal("time_s,x_m,y_m\n0,0,0\n1,10,0\n4,40,0\n5,50,0\n") == "taken");
}

TEST_CASE("a table with faults is refused with the line and the fault") {
  CHECK(says(refusal("time_s,x_m\n0,0\n1,1\n"), "neither a path nor a table of speeds"));
  CHECK(says(refusal("time_s,x_m,y_m,speed_mps\n0,0,0,1\n1,1,0,1\n"), "neither a path nor a table of speeds"));
  CHECK(says(refusal("time_s,speed_kmh,speed_mps\n0,0,0\n1,1,0\n"), "comes twice"));
  CHECK(says(refusal("time_s,speed_kmh,x_m_pm,y_m_pm\n0,0,1,1\n1,1,1,1\n"),
             "x_m_pm is the ± of a column that is not there"));
  CHECK(says(refusal("time_s,colour\n0,0\n"), "edr.csv:1: \"colour\" is no column"));
  CHECK(says(refusal("time_s;speed_kmh\n0;50,0\n"), "set commas between the columns"));
  CHECK(says(refusal("time_s\tspeed_kmh\n0\t50\n"), "set commas between the columns"));
  CHECK(says(refusal("time_s,speed_mps\n0,3\n0,4\n"), "edr.csv:3: time_s 0 follows 0"));
  CHECK(says(refusal("time_s,speed_mps\n0,nan\n"), "edr.csv:2: speed_mps is \"nan\""));
  CHECK(says(refusal("time_s,speed_mps,speed_mps_pm\n0,3,-1\n"), "speed_mps_pm is \"-1\""));
  CHECK(says(refusal("time_s,speed_mps\n0,3\n"), "fewer than two rows"));
  CHECK(says(refusal("time_s,speed_mps\n0,3,4\n"), "3 numbers for 2 columns"));
}

TEST_CASE("a run departs from the table by a share of its rows' ±, the same in all rows") {
  const GivenMotion motion = read("time_s,speed_mps,speed_mps_pm\n0,10,0.5\n1,10,0.5\n2,10,1\n");
  const GivenMotion faster = deviating(motion, {.share = {.speed_mps = 1.0}});
  const GivenMotion slower = deviating(motion, {.share = {.speed_mps = -1.0}});
  CHECK(motion_at(motion, 2.0).place_m.x == doctest::Approx(20.0));
  CHECK(motion_at(faster, 2.0).place_m.x == doctest::Approx(20.0 + 0.5 + 0.75));
  CHECK(motion_at(slower, 2.0).place_m.x == doctest::Approx(20.0 - 0.5 - 0.75));
  const GivenMotion same = deviating(motion, {});
  CHECK(motion_at(same, 1.7).place_m == motion_at(motion, 1.7).place_m);
}

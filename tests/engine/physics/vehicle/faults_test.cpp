#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/physics/vehicle/manoeuvre.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::vehicle;

namespace {

bool has_figure(const ManoeuvreReport& report, std::string_view name) {
  return std::ranges::find(report.figures, name, &Figure::name) != report.figures.end();
}

bool says(const ManoeuvreReport& report, std::string_view what) {
  return std::ranges::any_of(report.faults,
                             [&](const std::string& fault) { return fault.find(what) != std::string::npos; });
}

ManoeuvreReport run(std::string_view manoeuvre, const std::string& car, const ManoeuvreOptions& options = {}) {
  auto report = run_manoeuvre(manoeuvre, read_car(car), options);
  REQUIRE(report.has_value());
  return *report;
}

}  // namespace

TEST_CASE("a sound manoeuvre has no faults") {
  for (const char* manoeuvre : {"acceleration", "stop", "coast-down"}) {
    CAPTURE(manoeuvre);
    CHECK(run(manoeuvre, "volvo-s80").faults.empty());
  }
}

TEST_CASE("a speed that was not reached is a fault and no figure") {
  const ManoeuvreReport spinning = run("acceleration", "commonroad-bmw-320i");
  CHECK(says(spinning, "60 mph was not reached in 100 s"));
  CHECK(!has_figure(spinning, "0-60 mph"));
  const ManoeuvreReport endless = run("acceleration", "commonroad-escort");
  CHECK(!endless.faults.empty());
  for (const Figure& figure : endless.figures) CHECK(figure.value < 350.0);
}

TEST_CASE("a step of steer to the right answers as one to the left and one that takes too long is a fault") {
  ManoeuvreOptions left, right, endless;
  left.steer_rad = 0.04;
  right.steer_rad = -0.04;
  endless.steer_rad = 1.5;
  const ManoeuvreReport one = run("step-steer", "volvo-s80", left), other = run("step-steer", "volvo-s80", right);
  CHECK(one.faults.empty());
  CHECK(other.faults.empty());
  CHECK(one.figure("steady yaw rate") > 0.1);
  CHECK(one.figure("yaw rate t90") > 0.0);
  CHECK(other.figure("steady yaw rate") == relative(-one.figure("steady yaw rate"), 0.02));
  for (const char* same : {"yaw rate t90", "lateral acceleration t90"}) {
    CAPTURE(same);
    CHECK(std::abs(other.figure(same) - one.figure(same)) < 0.02);
  }
  CHECK(std::abs(other.figure("yaw rate overshoot") - one.figure("yaw rate overshoot")) < 2.0);
  CHECK(says(run("step-steer", "volvo-s80", endless), "the steering takes 3.8 s"));
}

TEST_CASE("a stop that does not end and a coast-down without drag are faults") {
  ManoeuvreOptions slippery;
  slippery.friction = 0.01;
  const ManoeuvreReport sliding = run("stop", "volvo-s80", slippery);
  CHECK(says(sliding, "did not stop within 120 s"));
  CHECK(!has_figure(sliding, "stopping distance"));
  CHECK(says(run("coast-down", "commonroad-escort"), "20 km/h was not reached"));
  ManoeuvreOptions slow;
  slow.speed_mps = 20.0;
  const ManoeuvreReport from_72 = run("coast-down", "volvo-s80", slow);
  CHECK(from_72.faults.empty());
  CHECK(!has_figure(from_72, "deceleration at 100 km/h"));
  CHECK(has_figure(from_72, "deceleration at 50 km/h"));
}

TEST_CASE("a bend that the grip does not give and a spin are faults") {
  ManoeuvreOptions ice;
  ice.friction = 0.15;
  CHECK(says(run("steady-circle", "volvo-s80", ice), "4 m/s2 was not reached"));
  std::vector<TimedInput> rows(3);
  rows[0].input.steering_wheel_rad = rows[1].input.steering_wheel_rad = rows[2].input.steering_wheel_rad = 3.0;
  for (TimedInput& row : rows) row.input.parking_brake = true;
  rows[1].time_s = 1.0;
  rows[2].time_s = 4.0;
  ManoeuvreOptions fast;
  fast.speed_mps = 20.0;
  fast.friction = 0.3;
  CHECK(says(drive_inputs(read_car("volvo-s80"), fast, rows), "the car spun"));
}

TEST_CASE("given inputs are driven as they are given") {
  std::vector<TimedInput> rows(3);
  rows[1].time_s = 2.0;
  rows[2].time_s = 4.0;
  rows[2].input.steering_wheel_rad = 0.4;
  ManoeuvreOptions options;
  options.speed_mps = 25.0;
  const ManoeuvreReport report = drive_inputs(read_car("volvo-s80"), options, rows);
  CHECK(report.faults.empty());
  const double ratio = read_car("volvo-s80").steering.ratio;
  constexpr double step_s = 0.001;  // A sample holds the state of the step before it.
  for (const ManoeuvreSample& sample : report.series)
    CHECK(std::abs(sample.steer_rad * ratio - 0.2 * std::max(0.0, sample.time_s - step_s - 2.0)) < 1e-9);
  CHECK(report.series.back().time_s == doctest::Approx(4.0));
  CHECK(report.figure("peak yaw rate") > 2.0);
}

#include "engine/road/plan_curve.hpp"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/relative.hpp"

namespace septet::road {
namespace {

/// The end of a clothoid by brute force: the midpoint rule with a million steps.
Vec2 integrate(double heading, double k0, double k1, double length) {
  const int steps = 1'000'000;
  const double step = length / steps;
  Vec2 sum(0.0);
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) * step;
    const double angle = heading + k0 * u + 0.5 * (k1 - k0) / length * u * u;
    sum += step * Vec2(std::cos(angle), std::sin(angle));
  }
  return sum;
}

void check_unit_speed(const PlanCurve& curve, double length) {
  for (double s = 1.0; s < length - 1.0; s += 0.37) {
    const Vec2 before = evaluate_plan(curve, s - 1e-4).position_m, after = evaluate_plan(curve, s + 1e-4).position_m;
    const PlanPoint point = evaluate_plan(curve, s);
    REQUIRE(glm::distance(before, after) == relative(2e-4, 1e-6));
    REQUIRE(glm::distance((after - before) / 2e-4, point.direction) < 1e-6);
    const Vec2 turn = (evaluate_plan(curve, s + 1e-4).direction - evaluate_plan(curve, s - 1e-4).direction) / 2e-4;
    REQUIRE(turn.y * point.direction.x - turn.x * point.direction.y ==
            doctest::Approx(point.curvature_per_m).epsilon(1e-4).scale(1e-2));
  }
}

}  // namespace

TEST_CASE("an arc is a circle") {
  PlanCurve curve;
  REQUIRE(append_clothoid(curve, {0.0, {10.0, -5.0}, 1.0, 250.0}, -0.02, -0.02));
  const Vec2 centre = Vec2(10.0, -5.0) + 50.0 * Vec2(std::sin(1.0), -std::cos(1.0));
  for (double s = 0.0; s <= 250.0; s += 7.3) {
    const PlanPoint point = evaluate_plan(curve, s);
    CHECK(glm::distance(point.position_m, centre) == relative(50.0, 1e-12));
    CHECK(std::remainder(std::atan2(point.direction.y, point.direction.x) - (1.0 - 0.02 * s), 6.283185307179586) ==
          doctest::Approx(0.0));
    CHECK(point.curvature_per_m == -0.02);
  }
}

TEST_CASE("a spiral ends where its tangent integrates to") {
  for (const auto& [k0, k1, length] :
       {std::tuple{0.0, 0.05, 80.0}, {-0.01, 0.02, 300.0}, {0.1, -0.1, 120.0}, {1e-7, 0.0, 150.0}}) {
    PlanCurve curve;
    REQUIRE(append_clothoid(curve, {0.0, {0.0, 0.0}, 0.3, length}, k0, k1));
    CHECK(glm::distance(evaluate_plan(curve, length).position_m, integrate(0.3, k0, k1, length)) < 1e-8);
    check_unit_speed(curve, length);
  }
}

TEST_CASE("an arc without curvature is a line") {
  PlanCurve curve;
  REQUIRE(append_clothoid(curve, {0.0, {1.0, 2.0}, 0.0, 40.0}, 0.0, 0.0));
  CHECK(evaluate_plan(curve, 40.0).position_m.x == 41.0);
  CHECK(evaluate_plan(curve, 40.0).position_m.y == 2.0);
}

TEST_CASE("both ranges of a parametric cubic give the same curve by arc length") {
  // u = 60 p, v = 20 p² − 5 p³ over p in 0…1; the length by a fine polygon.
  double length = 0.0;
  Vec2 last(0.0);
  for (int i = 1; i <= 200'000; ++i) {
    const double p = i / 200'000.0;
    const Vec2 point(60.0 * p, 20.0 * p * p - 5.0 * p * p * p);
    length += glm::distance(point, last);
    last = point;
  }
  PlanCurve normalized, arc_length;
  const double l = length;
  REQUIRE(append_cubic(normalized, {0.0, {0.0, 0.0}, 0.0, l}, {{0, 60, 0, 0}, {0, 0, 20, -5}}, CubicRange::normalized));
  REQUIRE(append_cubic(arc_length, {0.0, {0.0, 0.0}, 0.0, l},
                       {{0, 60 / l, 0, 0}, {0, 0, 20 / (l * l), -5 / (l * l * l)}}, CubicRange::arc_length));
  check_unit_speed(normalized, length);
  for (double s = 0.0; s <= length; s += 0.9) {
    CHECK(glm::distance(evaluate_plan(normalized, s).position_m, evaluate_plan(arc_length, s).position_m) < 1e-9);
  }
  CHECK(glm::distance(evaluate_plan(normalized, length).position_m, Vec2(60.0, 15.0)) < 1e-6);
}

TEST_CASE("a cubic over its abscissa is run through by arc length") {
  PlanCurve curve;
  REQUIRE(
      append_cubic(curve, {0.0, {0.0, 0.0}, 0.0, 50.0}, {{0, 1, 0, 0}, {0.5, 0.1, 0.01, -1e-4}}, CubicRange::abscissa));
  check_unit_speed(curve, 50.0);
  CHECK(glm::distance(evaluate_plan(curve, 0.0).position_m, Vec2(0.0, 0.5)) < 1e-12);
  const Vec2 end = evaluate_plan(curve, 50.0).position_m;
  CHECK(end.x < 50.0);
  CHECK(end.y == relative(0.5 + 0.1 * end.x + 0.01 * end.x * end.x - 1e-4 * end.x * end.x * end.x, 1e-12));
}

TEST_CASE("a cubic that stands still and a curve that turns without end are refused") {
  PlanCurve curve;
  CHECK_FALSE(append_cubic(curve, {0.0, {0.0, 0.0}, 0.0, 50.0}, {{0, 0, 0, 0}, {0, 0, 0, 0}}, CubicRange::normalized));
  CHECK_FALSE(
      append_cubic(curve, {0.0, {0.0, 0.0}, 0.0, 50.0}, {{0, 1e300, 0, 1e300}, {0, 0, 0, 0}}, CubicRange::arc_length));
  CHECK_FALSE(append_clothoid(curve, {0.0, {0.0, 0.0}, 0.0, 1e6}, 0.0, 1e6));
  CHECK(curve.records.empty());
}

}  // namespace septet::road

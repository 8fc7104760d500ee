#include "engine/physics/impact/impulse.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/engine/physics/impact/moved_world.hpp"
#include "tests/engine/physics/impact/pairs.hpp"
#include "tests/engine/physics/impact/random_impact.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::impact;

namespace {

constexpr int trials = 20000;

Vec2 momentum_ns(const Body& body) {
  return std::isfinite(body.mass_kg) ? body.mass_kg * body.velocity_mps : Vec2(0.0);
}

/// About the world's origin, where the contact is.
double angular_momentum_nms(const Body& body) {
  if (!std::isfinite(body.mass_kg)) return 0.0;
  return cross(body.mass_centre_m, momentum_ns(body)) + body.yaw_inertia_kgm2 * body.yaw_rate_radps;
}

}  // namespace

TEST_CASE("worked pairs come out to the last digit given") {
  for (const WorkedPair& pair : worked_pairs()) {
    CAPTURE(pair.name);
    Body first = pair.first, second = pair.second;
    const auto impulse = impulse_at(first, second, pair.place(), pair.rule);
    REQUIRE(impulse);
    CHECK(impulse->sticks == pair.sticks);
    exchange(*impulse, 1.0, first, second);
    CHECK(glm::distance(first.velocity_mps, pair.first_velocity_mps) < 1e-6);
    CHECK(glm::distance(second.velocity_mps, pair.second_velocity_mps) < 1e-6);
    CHECK(std::abs(first.yaw_rate_radps - pair.first_yaw_radps) < 1e-6);
    CHECK(std::abs(second.yaw_rate_radps - pair.second_yaw_radps) < 1e-6);
    CHECK(std::abs(impulse->normal_ns - pair.normal_ns) < 1e-3);
    CHECK(std::abs(impulse->tangential_ns - pair.tangential_ns) < 1e-3);
    const double lost_j = kinetic_loss_j(pair.first, first) + kinetic_loss_j(pair.second, second);
    CHECK(std::abs(lost_j - pair.loss_j) < 1e-3);
  }
}

TEST_CASE("momentum and angular momentum are kept, and the energy lost is Kelvin's") {
  Random random(seed);
  double worst_linear = 0.0, worst_angular = 0.0, worst_energy = 0.0, least_loss_j = INFINITY;
  for (int i = 0; i < trials; ++i) {
    const RandomImpact impact = random_impact(random);
    Body first = impact.first, second = impact.second;
    const auto impulse = impulse_at(first, second, impact.place, impact.rule);
    const Vec2 before = velocity_at(first, impulse->first_arm_m) - velocity_at(second, impulse->second_arm_m);
    exchange(*impulse, 1.0, first, second);
    const Vec2 after = velocity_at(first, impulse->first_arm_m) - velocity_at(second, impulse->second_arm_m);
    const double kelvin_j = 0.5 * glm::dot(impulse->on_second_ns, before + after);
    const double lost_j = kinetic_loss_j(impact.first, first) + kinetic_loss_j(impact.second, second);
    const double scale_j = glm::length(impulse->on_second_ns) * (glm::length(before) + glm::length(after));
    worst_energy = std::max(worst_energy, std::abs(kelvin_j - lost_j) / scale_j);
    least_loss_j = std::min(least_loss_j, lost_j / scale_j);
    CHECK(glm::dot(after, impact.place.normal) ==
          doctest::Approx(impulse->closing_mps - (1.0 + impact.rule.restitution) * impulse->stopped_mps)
              .scale(1.0 + glm::length(before))
              .epsilon(1e-9));
    if (!std::isfinite(impact.second.mass_kg)) continue;
    const Vec2 sum = momentum_ns(first) + momentum_ns(second);
    const Vec2 sum_before = momentum_ns(impact.first) + momentum_ns(impact.second);
    worst_linear = std::max(worst_linear, glm::distance(sum, sum_before) /
                                              (glm::length(momentum_ns(first)) + glm::length(momentum_ns(second))));
    const double spin = angular_momentum_nms(first) + angular_momentum_nms(second);
    const double spin_before = angular_momentum_nms(impact.first) + angular_momentum_nms(impact.second);
    worst_angular =
        std::max(worst_angular, std::abs(spin - spin_before) / (std::abs(angular_momentum_nms(impact.first)) +
                                                                std::abs(angular_momentum_nms(impact.second))));
  }
  MESSAGE("shares at worst: momentum " << worst_linear << ", angular " << worst_angular << ", energy " << worst_energy
                                       << "; least loss " << least_loss_j);
  CHECK(worst_linear < 1e-9);
  CHECK(worst_angular < 1e-9);
  CHECK(worst_energy < 1e-6);
  CHECK(least_loss_j > -1e-12);
}

TEST_CASE("which body is called the first changes nothing") {
  Random random(seed, 1);
  double worst = 0.0;
  for (int i = 0; i < trials; ++i) {
    const RandomImpact impact = random_impact(random);
    const auto impulse = impulse_at(impact.first, impact.second, impact.place, impact.rule);
    const auto swapped =
        impulse_at(impact.second, impact.first, {impact.place.point_m, -impact.place.normal}, impact.rule);
    REQUIRE(swapped);
    CHECK(swapped->sticks == impulse->sticks);
    worst = std::max(worst,
                     glm::distance(impulse->on_second_ns, -swapped->on_second_ns) / glm::length(impulse->on_second_ns));
  }
  MESSAGE("at worst " << worst);
  CHECK(worst < 1e-12);
}

TEST_CASE("a turned and moved world has the same impact, turned") {
  Random random(seed, 2);
  double worst = 0.0;
  for (int i = 0; i < trials; ++i) {
    const RandomImpact impact = random_impact(random);
    const auto impulse = impulse_at(impact.first, impact.second, impact.place, impact.rule);
    if (impulse->stopped_mps < 1.0) continue;  // Below, the closing speed is a small difference of large ones.
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Vec2 by(random.uniform(-100.0, 100.0), random.uniform(-100.0, 100.0));
    const Vec2 j = impulse->on_second_ns;
    const Place place{by, turned(impact.place.normal, angle)};
    const auto there = impulse_at(in_moved_world(impact.first, angle, by), in_moved_world(impact.second, angle, by),
                                  place, impact.rule);
    REQUIRE(there);
    worst = std::max(worst, glm::distance(there->on_second_ns, turned(j, angle)) / glm::length(j));
  }
  MESSAGE("at worst " << worst);
  CHECK(worst < 1e-12);
}

TEST_CASE("surfaces that part, and two things that stand fast, exchange nothing") {
  const Body car = body_at(1500, 2500, {2, 0}, {-1, 0});
  CHECK(!impulse_at(car, {}, {}, {}));
  CHECK(!impulse_at({}, {}, {}, {}));
  CHECK(impulse_at(body_at(1500, 2500, {2, 0}, {1, 0}), {}, {}, {}));
}

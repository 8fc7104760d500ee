#include "engine/physics/impact/pulse.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/engine/physics/impact/pairs.hpp"
#include "tests/engine/physics/impact/random_impact.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::impact;

namespace {

CrushCurve curve_of(const Body& first, const Body& second) {
  return crush_curve({first.mass_kg, passenger_car_crush()}, {second.mass_kg, passenger_car_crush()});
}

/// The bodies move on by their own velocities, as in a drive.
void move(Body& body, double dt_s) { body.mass_centre_m += dt_s * body.velocity_mps; }

struct Spread {
  Body first, second;
  Pulse pulse;
  Vec2 given_ns{0.0};
};

Spread spread(const Body& first, const Body& second, const Place& place, const Rule& rule, double dt_s) {
  Spread result{first, second, {}};
  const auto impulse = impulse_at(first, second, place, rule);
  REQUIRE(impulse);
  result.pulse = pulse_of(*impulse, place.normal, curve_of(first, second), rule.restitution);
  while (!is_over(result.pulse)) {
    result.given_ns += advance_pulse(dt_s, result.pulse, result.first, result.second);
    move(result.first, dt_s);
    move(result.second, dt_s);
  }
  return result;
}

}  // namespace

TEST_CASE("a pulse changes speeds and turns as the closed form does, in long steps and short ones") {
  for (const WorkedPair& pair : worked_pairs()) {
    CAPTURE(pair.name);
    for (const double dt_s : {1.0 / 120.0, 1.0 / 960.0, 1e-4}) {
      Body first = pair.first, second = pair.second;
      exchange(*impulse_at(first, second, pair.place(), pair.rule), 1.0, first, second);
      const Spread spread_out = spread(pair.first, pair.second, pair.place(), pair.rule, dt_s);
      const double delta_v = glm::distance(first.velocity_mps, pair.first.velocity_mps);
      CHECK(glm::distance(spread_out.first.velocity_mps, first.velocity_mps) < 1e-12 * delta_v);
      CHECK(glm::distance(spread_out.second.velocity_mps, second.velocity_mps) < 1e-12 * delta_v);
      CHECK(std::abs(spread_out.first.yaw_rate_radps - first.yaw_rate_radps) < 1e-12);
      CHECK(std::abs(spread_out.second.yaw_rate_radps - second.yaw_rate_radps) < 1e-12);
    }
  }
}

TEST_CASE("two vehicles exchange their impulse in 57 to 77 ms at the speeds of collisions") {
  const Body car = body_at(1500, 2500, {2, 0}, {0, 0});
  for (const double closing_mps : {10.0, 15.0, 20.0, 30.0, 35.0}) {
    Body other = body_at(1500, 2500, {-2, 0}, {-closing_mps, 0});
    const auto impulse = impulse_at(car, other, {}, {.restitution = 0.12});
    const Pulse pulse = pulse_of(*impulse, {1, 0}, curve_of(car, other), 0.12);
    CAPTURE(closing_mps);
    CHECK(duration_s(pulse) >= 0.057);
    CHECK(duration_s(pulse) <= 0.077);
  }
}

TEST_CASE("every step of a pulse keeps momentum, and the ledger closes") {
  Random random(seed);
  double worst_ledger = 0.0, worst_loss = 0.0, worst_momentum = 0.0, worst_turn = 0.0, least_friction = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const RandomImpact impact = random_impact(random);
    Body first = impact.first, second = impact.second, instant_first = first, instant_second = second;
    const auto impulse = impulse_at(first, second, impact.place, impact.rule);
    exchange(*impulse, 1.0, instant_first, instant_second);
    Pulse pulse = pulse_of(*impulse, impact.place.normal, curve_of(first, second), impact.rule.restitution);
    while (!is_over(pulse)) {
      const Body before_first = first, before_second = second;
      const Vec2 given_ns = advance_pulse(1.0 / 960.0, pulse, first, second);
      if (!std::isfinite(second.mass_kg) || glm::length(given_ns) == 0.0) continue;
      const Vec2 first_ns = first.mass_kg * (first.velocity_mps - before_first.velocity_mps);
      const Vec2 second_ns = second.mass_kg * (second.velocity_mps - before_second.velocity_mps);
      const double scale_ns =
          first.mass_kg * glm::length(first.velocity_mps) + second.mass_kg * glm::length(second.velocity_mps);
      worst_momentum = std::max(worst_momentum, glm::length(first_ns + second_ns) / scale_ns);
      const double first_nms = cross(-impulse->first_arm_m, first_ns) +
                               first.yaw_inertia_kgm2 * (first.yaw_rate_radps - before_first.yaw_rate_radps);
      const double second_nms = cross(-impulse->second_arm_m, second_ns) +
                                second.yaw_inertia_kgm2 * (second.yaw_rate_radps - before_second.yaw_rate_radps);
      const double turn_nms = scale_ns * (glm::length(impulse->first_arm_m) + glm::length(impulse->second_arm_m)) +
                              first.yaw_inertia_kgm2 * std::abs(first.yaw_rate_radps) +
                              second.yaw_inertia_kgm2 * std::abs(second.yaw_rate_radps);
      worst_turn = std::max(worst_turn, std::abs(first_nms + second_nms) / turn_nms);
    }
    const double loss_j = kinetic_loss_j(impact.first, instant_first) + kinetic_loss_j(impact.second, instant_second);
    const double scale_j = std::abs(pulse.ledger.crush_j) + std::abs(pulse.ledger.friction_j);
    worst_loss = std::max(worst_loss, std::abs(pulse.ledger.kinetic_j - loss_j) / scale_j);
    worst_ledger = std::max(
        worst_ledger, std::abs(pulse.ledger.kinetic_j - pulse.ledger.crush_j - pulse.ledger.friction_j) / scale_j);
    least_friction = std::min(least_friction, pulse.ledger.friction_j / pulse.ledger.crush_j);
    CHECK(pulse.ledger.crush_j >= 0.0);
  }
  MESSAGE("shares at worst: ledger " << worst_ledger << ", loss " << worst_loss << ", momentum " << worst_momentum
                                     << ", turn " << worst_turn << "; friction's least share of crush "
                                     << least_friction);
  CHECK(worst_ledger < 1e-6);
  CHECK(worst_loss < 1e-6);
  CHECK(worst_momentum < 1e-9);
  CHECK(worst_turn < 1e-9);
}

TEST_CASE("the crush takes the energy under its curve, less what springs back") {
  Body car = body_at(1500, 2500, {2, 0}, {20, 0}), wall;
  const Rule rule{.restitution = 0.11};
  Pulse pulse = pulse_of(*impulse_at(car, wall, {}, rule), {1, 0}, curve_of(car, wall), rule.restitution);
  while (!is_over(pulse)) advance_pulse(0.001, pulse, car, wall);
  // Force against depth, in strips.
  const int strips = 100000;
  double crush_j = 0.0;
  for (int i = 0; i < strips; ++i)
    crush_j +=
        1500.0 * deceleration_mps2(pulse.curve, (i + 0.5) / strips * pulse.most_depth_m) * pulse.most_depth_m / strips;
  CHECK(pulse.ledger.crush_j == relative(crush_j * (1.0 - 0.11 * 0.11), 1e-6));
  CHECK(car.velocity_mps.x == relative(-0.11 * 20.0, 1e-12));
}

TEST_CASE("a pulse begins and ends without a jump, and its overlap is the integral of its speed") {
  const WorkedPair pair = worked_pairs()[0];
  const Spread result = spread(pair.first, pair.second, pair.place(), pair.rule, 0.001);
  const Pulse& pulse = result.pulse;
  double depth = 0.0;
  const int steps = 100000;
  const double dt = duration_s(pulse) / steps;
  double worst_m = 0.0, worst_jump = 0.0, last = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double share = share_at(pulse, (i + 0.5) * dt);
    depth += dt * pulse.impulse.stopped_mps * (1.0 - (1.0 + pulse.restitution) * share);
    worst_m = std::max(worst_m, std::abs(depth - overlap_at_m(pulse, (i + 1) * dt)));
    const double rate = (share_at(pulse, (i + 1) * dt) - share_at(pulse, i * dt)) / dt;
    worst_jump = std::max(worst_jump, std::abs(rate - last) * dt);
    last = rate;
  }
  CHECK(worst_m < 1e-6);
  CHECK(worst_jump < 1e-5);
  CHECK(last < 1.0);
}

#include "engine/physics/impact/engagement.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "tests/engine/physics/impact/moved_world.hpp"
#include "tests/engine/physics/impact/two_bodies.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::impact;

namespace {

constexpr double tick_s = 1.0 / 120.0, step_s = tick_s / 8.0;

/// Two bodies that cross, most of which meet.
struct Crossing {
  Side first, second;
};
Crossing random_crossing(Random& random) {
  for (;;) {
    const double heading = random.uniform(0.0, 360.0), other_heading = random.uniform(0.0, 360.0);
    const Vec2 velocity = polar(random.uniform(0.0, 60.0), heading);
    const Vec2 other = polar(random.uniform() < 0.5 ? 0.0 : random.uniform(0.0, 60.0), other_heading);
    const double approach = glm::distance(velocity, other);
    if (approach < 1.0 || approach > 60.0) continue;
    const Vec2 place =
        8.0 * (velocity - other) / approach + polar(random.uniform(0.0, 3.0), random.uniform(0.0, 360.0));
    const double mass_kg = std::exp(random.uniform(std::log(100.0), std::log(40000.0)));
    return {car_at({0, 0}, heading, velocity), car_at(place, other_heading, other, mass_kg)};
  }
}

}  // namespace

TEST_CASE("a wall gives back 0.10 to 0.15 of the speed from 30 to 200 km/h") {
  for (const double speed_kmh : {30.0, 50.0, 64.0, 100.0, 200.0}) {
    CAPTURE(speed_kmh);
    const double speed = speed_kmh / 3.6;
    const Encounter met = encounter(car_at({-4, 0}, 0, {speed, 0}), wall_from({0, -20}, {0, 20}), step_s);
    REQUIRE(met.impact);
    const double back = -met.first.body.velocity_mps.x / speed;
    CHECK(back >= 0.10);
    CHECK(back <= 0.15);
  }
  CHECK(restitution(1.0) > 0.4);
  CHECK(restitution(2.0) > restitution(3.0));
}

TEST_CASE("no overlap goes beyond the crush by a centimetre, up to 60 m/s, in ticks and in eighths of them") {
  Random random(seed);
  double worst_m = -1.0;
  int met = 0, again = 0, set_apart = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto [first, second] = random_crossing(random);
    const Encounter crossing = encounter(first, second, i % 2 == 0 ? tick_s : step_s, vehicle_friction(), 1.0);
    if (!crossing.impact) continue;
    ++met;
    again += crossing.again > 0 ? 1 : 0;
    set_apart += crossing.engagement.set_apart_m > 0.1 ? 1 : 0;
    worst_m = std::max(worst_m, crossing.most_beyond_m);
  }
  MESSAGE(met << " meetings, overlap beyond the crush at most " << worst_m << " m; " << again << " met again, "
              << set_apart << " were set apart by more than 0.1 m");
  CHECK(met > 500);
  CHECK(worst_m <= 0.01);
  CHECK(set_apart < met / 8);
}

TEST_CASE("into a wall the overlap is the crush that the law foretells, with next to nothing set apart") {
  for (const double speed : {3.0, 15.0, 30.0, 60.0})
    for (const double angle : {0.0, 10.0, 20.0}) {
      CAPTURE(speed);
      CAPTURE(angle);
      const Encounter met =
          encounter(car_at({-4, 0}, angle, polar(speed, angle)), wall_from({0, -20}, {0, 20}), tick_s, 0.3, 4.0);
      REQUIRE(met.impact);
      CHECK(met.most_overlap_m <= met.impact->pulse.most_depth_m + 0.01);
      CHECK(met.most_overlap_m >= met.impact->pulse.most_depth_m - 0.03);
      CHECK(met.engagement.set_apart_m < 1e-4);
    }
}

TEST_CASE("a drive's long steps give the impulse of short ones") {
  Random random(seed, 1);
  for (int i = 0; i < 60; ++i) {
    const auto [first, second] = random_crossing(random);
    const Encounter coarse = encounter(first, second, tick_s, vehicle_friction(), 1.0);
    const Encounter fine = encounter(first, second, tick_s / 32.0, vehicle_friction(), 1.0);
    if (!coarse.impact || !fine.impact) continue;
    const Impulse &a = coarse.impact->pulse.impulse, &b = fine.impact->pulse.impulse;
    CHECK(glm::distance(a.on_second_ns, b.on_second_ns) < 1e-6 * glm::length(b.on_second_ns));
  }
}

TEST_CASE("a scrape of seven centimetres pushes both aside and slows both a little") {
  const Encounter met = encounter(car_at({-6, 0}, 0, {20, 0}), car_at({0, 1.73}, 0, {0, 0}), tick_s);
  REQUIRE(met.impact);
  const Vec2 delta_v = met.second.body.velocity_mps;
  MESSAGE("struck car: " << delta_v.x << ", " << delta_v.y << " m/s, " << met.second.body.yaw_rate_radps << " rad/s");
  CHECK(glm::length(delta_v) > 0.3);
  CHECK(glm::length(delta_v) < 3.0);
  CHECK(delta_v.y > 0.1);
  CHECK(delta_v.x > 0.1);
  CHECK(met.most_overlap_m < 0.09);
}

TEST_CASE("deeper scrapes are harder, and full overlap is hardest") {
  double last_ns = 0.0;
  for (const double overlap_m : {0.02, 0.07, 0.15, 0.3, 0.6, 1.0, 1.8}) {
    const Encounter met = encounter(car_at({-6, 0}, 0, {15, 0}), car_at({0, 1.8 - overlap_m}, 0, {0, 0}), tick_s);
    REQUIRE(met.impact);
    const double impulse_ns = glm::length(met.impact->pulse.impulse.on_second_ns);
    CHECK(impulse_ns > last_ns);
    last_ns = impulse_ns;
  }
}

TEST_CASE("which body is called the first, and where the world's axes lie, changes no meeting") {
  Random random(seed, 2);
  double worst_swap = 0.0, worst_turn = 0.0;
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    auto [first, second] = random_crossing(random);
    std::optional<Impact> impact;
    for (int k = 0; k < 120 && !impact; ++k) {
      first = moved(first, tick_s);
      second = moved(second, tick_s);
      impact = meet(first, second, 0.5, tick_s);
    }
    if (!impact || impact->pulse.impulse.stopped_mps < 1.0) continue;
    ++met;
    const Vec2 given = impact->pulse.impulse.on_second_ns;
    const auto swapped = meet(second, first, 0.5, tick_s);
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Vec2 by(random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0));
    const auto there = meet(in_moved_world(first, angle, by), in_moved_world(second, angle, by), 0.5, tick_s);
    REQUIRE(swapped);
    REQUIRE(there);
    worst_swap = std::max(worst_swap, glm::distance(given, -swapped->pulse.impulse.on_second_ns) / glm::length(given));
    worst_turn = std::max(worst_turn,
                          glm::distance(turned(given, angle), there->pulse.impulse.on_second_ns) / glm::length(given));
  }
  MESSAGE(met << " meetings, at worst: swapped " << worst_swap << ", turned and moved " << worst_turn);
  CHECK(met > 1000);
  CHECK(worst_swap < 1e-12);
  CHECK(worst_turn < 1e-12);
}

TEST_CASE("momentum is kept through a whole engagement, and its ledger closes") {
  Random random(seed, 3);
  double worst_momentum = 0.0, worst_ledger = 0.0, worst_loss = 0.0;
  for (int i = 0; i < 300; ++i) {
    const auto [first, second] = random_crossing(random);
    const Encounter met = encounter(first, second, step_s, vehicle_friction(), 1.0);
    if (!met.impact) continue;
    const Vec2 before = first.body.mass_kg * first.body.velocity_mps + second.body.mass_kg * second.body.velocity_mps;
    const Vec2 after =
        met.first.body.mass_kg * met.first.body.velocity_mps + met.second.body.mass_kg * met.second.body.velocity_mps;
    worst_momentum = std::max(worst_momentum, glm::distance(before, after) / glm::length(met.engagement.given_ns));
    const Ledger& ledger = met.engagement.ledger;
    const double scale_j = std::abs(ledger.crush_j) + std::abs(ledger.friction_j);
    worst_ledger = std::max(worst_ledger, std::abs(ledger.kinetic_j - ledger.crush_j - ledger.friction_j) / scale_j);
    const double loss_j = kinetic_loss_j(first.body, met.first.body) + kinetic_loss_j(second.body, met.second.body);
    worst_loss = std::max(worst_loss, std::abs(ledger.kinetic_j - loss_j) / scale_j);
  }
  MESSAGE("shares at worst: momentum " << worst_momentum << ", ledger " << worst_ledger << ", loss " << worst_loss);
  CHECK(worst_momentum < 1e-9);
  CHECK(worst_ledger < 1e-6);
  CHECK(worst_loss < 1e-6);
}

TEST_CASE("bodies that are apart again are forgotten, and those that touch at rest exchange nothing") {
  const Encounter met = encounter(car_at({-6, 0}, 0, {10, 0}), car_at({0, 0}, 0, {0, 0}), tick_s, 0.5, 4.0);
  REQUIRE(met.impact);
  CHECK(is_over(met.engagement, met.first.outline, met.second.outline));
  Engagement still;
  Side parked = car_at({0, 0}, 0, {0, 0}), beside = car_at({0, 1.7}, 0, {0, 0});
  CHECK(!advance_engagement(0.5, tick_s, still, parked, beside));
  CHECK(glm::length(parked.body.velocity_mps) == 0.0);
}

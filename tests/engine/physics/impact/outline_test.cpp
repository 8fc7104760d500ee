#include "engine/physics/impact/outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "tests/engine/physics/impact/moved_world.hpp"
#include "tests/engine/physics/impact/pairs.hpp"

using namespace septet;
using namespace septet::impact;

namespace {

Outline random_outline(Random& random, double reach_m) {
  const Vec2 centre_m(random.uniform(-reach_m, reach_m), random.uniform(-reach_m, reach_m));
  if (random.uniform() < 0.2) return post_outline(centre_m, random.uniform(0.05, 0.5));
  if (random.uniform() < 0.2)
    return wall_outline(centre_m, centre_m + polar(random.uniform(0.5, 8.0), random.uniform(0.0, 360.0)),
                        random.uniform(0.05, 0.3));
  return box_outline(centre_m, polar(1.0, random.uniform(0.0, 360.0)),
                     {random.uniform(0.2, 3.0), random.uniform(0.2, 1.3)}, random.uniform(0.001, 0.4));
}

/// Points on the outline: of its rounded corners and straight sides.
std::vector<Vec2> points_of(const Outline& outline, int count) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const Vec2 way = polar(1.0, 360.0 * i / count);
    const Vec2 core = outline.half_m - outline.round_m;
    for (const double along : {-1.0, 1.0})
      for (const double across : {-1.0, 1.0}) {
        if (way.x * along < -1e-12 || way.y * across < -1e-12) continue;
        const Vec2 local = core * Vec2(along, across) + outline.round_m * way;
        points.push_back(outline.centre_m + local.x * outline.forward + local.y * left_of(outline.forward));
      }
    const double share = 2.0 * i / count - 1.0;
    for (const double side : {-1.0, 1.0}) {
      const Vec2 long_side(share * core.x, side * outline.half_m.y), end(side * outline.half_m.x, share * core.y);
      for (const Vec2& local : {long_side, end})
        points.push_back(outline.centre_m + local.x * outline.forward + local.y * left_of(outline.forward));
    }
  }
  return points;
}

}  // namespace

TEST_CASE("the gap between two outlines is the least distance of their points") {
  Random random(seed);
  int apart = 0;
  for (int i = 0; i < 120; ++i) {
    const Outline first = random_outline(random, 4.0), second = random_outline(random, 4.0);
    const Meeting meeting = nearest(first, second);
    if (meeting.gap_m <= 0.0) continue;
    ++apart;
    double least = INFINITY;
    const auto others = points_of(second, 150);
    for (const Vec2& a : points_of(first, 150))
      for (const Vec2& b : others) least = std::min(least, glm::distance(a, b));
    CHECK(meeting.gap_m <= least + 1e-9);
    CHECK(meeting.gap_m >= least - 0.05);
  }
  CHECK(apart > 40);
}

TEST_CASE("outlines that overlap are apart once one is moved by the depth along the normal") {
  Random random(seed, 1);
  int met = 0;
  for (int i = 0; i < 5000; ++i) {
    const Outline first = random_outline(random, 2.0);
    Outline second = random_outline(random, 2.0);
    const auto contact = contact_of(first, second);
    CHECK(contact.has_value() == (nearest(first, second).gap_m <= 0.0));
    if (!contact) continue;
    ++met;
    second.centre_m -= (contact->gap_m - 1e-9) * contact->place.normal;
    CHECK(!contact_of(first, second));
    second.centre_m -= 2e-9 * contact->place.normal;
    const double gap_m = nearest(first, second).gap_m;
    CHECK(gap_m > -1e-8);
  }
  CHECK(met > 1000);
}

TEST_CASE("which outline is called the first changes nothing, nor does the place of the world's origin") {
  Random random(seed, 2);
  double worst_gap = 0.0, worst_normal = 0.0, worst_point = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const Outline first = random_outline(random, 3.0), second = random_outline(random, 3.0);
    const Meeting meeting = nearest(first, second), swapped = nearest(second, first);
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Vec2 by(random.uniform(-100.0, 100.0), random.uniform(-100.0, 100.0));
    const Meeting there = nearest(in_moved_world(first, angle, by), in_moved_world(second, angle, by));
    worst_gap = std::max({worst_gap, std::abs(meeting.gap_m - swapped.gap_m), std::abs(meeting.gap_m - there.gap_m)});
    // Two outlines side by side have more than one nearest point: there the gap alone is compared.
    if (std::abs(cross(first.forward, second.forward)) < 1e-9) continue;
    worst_normal = std::max({worst_normal, glm::distance(meeting.place.normal, -swapped.place.normal),
                             glm::distance(turned(meeting.place.normal, angle), there.place.normal)});
    worst_point = std::max({worst_point, glm::distance(meeting.place.point_m, swapped.place.point_m),
                            glm::distance(turned(meeting.place.point_m, angle) + by, there.place.point_m)});
  }
  MESSAGE("at worst: gap " << worst_gap << " m, normal " << worst_normal << ", point " << worst_point << " m");
  CHECK(worst_gap < 1e-12);
  CHECK(worst_normal < 1e-12);
  CHECK(worst_point < 1e-12);
}

TEST_CASE("a car meets a post and a wall where it stands before them") {
  const Outline car = box_outline({0, 0}, {1, 0}, {2.25, 0.9}, 0.3);
  const auto post = contact_of(car, post_outline({2.4, 0.5}, 0.2));
  REQUIRE(post);
  CHECK(post->gap_m == doctest::Approx(-0.05).epsilon(1e-12).scale(0.05));
  CHECK(glm::distance(post->place.normal, Vec2(1, 0)) < 1e-12);
  CHECK(glm::distance(post->place.point_m, Vec2(2.225, 0.5)) < 1e-12);
  CHECK(!contact_of(car, post_outline({2.4, 0.5}, 0.1)));
  const auto wall = contact_of(car, wall_outline({-10, 1.0}, {10, 1.0}, 0.15));
  REQUIRE(wall);
  CHECK(glm::distance(wall->place.normal, Vec2(0, 1)) < 1e-12);
  CHECK(wall->gap_m == doctest::Approx(-0.05).epsilon(1e-12).scale(0.05));
}

TEST_CASE("the crush of a front that meets a wall squarely carries in its middle, askew towards its corner") {
  const Outline wall = wall_outline({2.35, -20}, {2.35, 20}, 0.1);
  double last_m = 0.0;
  for (const double heading_deg : {0.0, 1.0, 5.0, 10.0, 20.0, 40.0}) {
    Outline car = box_outline({0, 0}, polar(1.0, heading_deg), {2.25, 0.9}, 0.3);
    car.centre_m.x += nearest(car, wall).gap_m;
    const Place touch = nearest(car, wall).place;
    const double middle_m = car.centre_m.y + 2.25 * car.forward.y;
    const double aside_m = std::abs(engaged_point_m(car, wall, touch, 0.3).y - middle_m);
    CHECK(aside_m <= 0.9);
    CHECK(aside_m >= last_m - 1e-12);
    last_m = aside_m;
    if (heading_deg <= 5.0) CHECK(aside_m < 0.15);
  }
  CHECK(last_m > 0.3);
}

TEST_CASE("cars that overlap by seven centimetres are past each other by that, those in line not at all") {
  const Outline ahead = box_outline({0, 0}, {1, 0}, {2.25, 0.9}, 0.3);
  const auto behind = [](double aside_m) { return box_outline({-6, aside_m}, {1, 0}, {2.25, 0.9}, 0.3); };
  CHECK(passing(behind(1.73), ahead, {20, 0}).depth_m == doctest::Approx(0.07 * 1.8 / 1.73).epsilon(1e-9).scale(0.07));
  CHECK(passing(behind(0.0), ahead, {20, 0}).depth_m == INFINITY);
  CHECK(passing(behind(1.9), ahead, {20, 0}).depth_m == 0.0);
}

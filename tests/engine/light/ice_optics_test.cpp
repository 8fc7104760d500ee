/// Equations 1 to 4 of the paper as they are drawn, each against figures worked out by hand or against another law.

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "engine/light/fresnel.hpp"
#include "engine/light/ice_optics.hpp"
#include "tests/relative.hpp"

namespace septet::light {
namespace {

constexpr float exact = 2e-6f;  // Of single precision.

vec3 any_direction(Random& random) { return normalize(vec3(random.normal(), random.normal(), random.normal())); }

float apart(const vec3& a, const vec3& b) { return length(a - b); }

}  // namespace

TEST_CASE("equation 1 with the paper's share of 0.33 takes the back normal away as printed and adds it for a lens") {
  const vec3 front(0, 0, 1), back(0.6, 0, -0.8);
  // 0.67 (0, 0, 1) − 0.33 (0.6, 0, −0.8) = (−0.198, 0, 0.934), of length 0.954756513.
  CHECK(apart(blended_normal(front, back, 1.0f - paper_back_share, -paper_back_share),
              vec3(-0.198, 0, 0.934) / 0.9547565134f) < exact);
  // 0.67 (0, 0, 1) + 0.33 (0.6, 0, −0.8) = (0.198, 0, 0.406), of length 0.451707870.
  CHECK(apart(blended_normal(front, back, 1.0f - paper_back_share, paper_back_share),
              vec3(0.198, 0, 0.406) / 0.4517078702f) < exact);
  CHECK(apart(blended_normal(front, back, 1.0f, 0.0f), front) < exact);
  CHECK(apart(blended_normal(front, back, 0.0f, -1.0f), -back) < exact);
  // Where the two cancel there is no direction: the front face's stays.
  CHECK(apart(blended_normal(front, front, 0.5f, -0.5f), front) < exact);
}

TEST_CASE("equation 2 obeys Snell's law in the plane of incidence and gives a unit vector") {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const vec3 normal = any_direction(random);
    vec3 eye = any_direction(random);
    if (dot(eye, normal) > 0.0) eye = -eye;
    const vec3 inside = refracted(eye, normal, into_ice);
    CHECK(std::abs(length(inside) - 1.0f) < exact);
    const float before = length(cross(eye, normal)), after = length(cross(inside, normal));
    CHECK(std::abs(air_index * before - ice_index * after) < exact);
    CHECK(std::abs(dot(cross(eye, normal), inside)) < exact);
  }
  // 45° in: sin = 0.70710678 · 1.0003 / 1.3091 = 0.54030931.
  const vec3 inside = refracted(normalize(vec3(1, 0, -1)), vec3(0, 0, 1), into_ice);
  CHECK(apart(inside, vec3(0.54030931, 0, -0.84146649)) < exact);
}

TEST_CASE("light that meets the ice's face from within beyond 49.8 degrees is reflected wholly") {
  const float limit = std::asin(air_index / ice_index);
  CHECK(limit * 180.0f / pi == relative(49.826, 1e-4));
  const auto within = [](float angle) { return vec3(std::sin(angle), 0, -std::cos(angle)); };
  CHECK(length(refracted(within(limit - 1e-3f), vec3(0, 0, 1), out_of_ice)) == relative(1.0, 1e-5));
  CHECK(refracted(within(limit + 1e-3f), vec3(0, 0, 1), out_of_ice) == vec3(0.0f));
  CHECK(fresnel(std::cos(limit + 1e-3f), out_of_ice) == 1.0f);
  CHECK(fresnel(std::cos(limit - 1e-3f), out_of_ice) < 1.0f);
}

TEST_CASE("equation 3 keeps length and angle and turns back what comes from the front") {
  CHECK(apart(mirrored_way(vec3(0.6, 0, -0.8), vec3(0, 0, 1)), vec3(0.6, 0, 0.8)) < exact);
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const vec3 normal = any_direction(random), eye = any_direction(random), mirrored = mirrored_way(eye, normal);
    CHECK(std::abs(length(mirrored) - 1.0f) < exact);
    CHECK(std::abs(dot(mirrored, normal) + dot(eye, normal)) < exact);
    CHECK(apart(mirrored_way(mirrored, normal), eye) < exact);
  }
}

TEST_CASE("equation 4 is none straight on, all at grazing, and an eighth at 60 degrees") {
  CHECK(paper_fresnel(1.0f) == 0.0f);
  CHECK(paper_fresnel(0.0f) == 1.0f);
  CHECK(paper_fresnel(0.5f) == 0.125f);
}

TEST_CASE("Fresnel's own equations give ((n - 1)/(n + 1))² straight on and one polarisation at Brewster's angle") {
  const double n = double(ice_index) / double(air_index), straight = (n - 1.0) / (n + 1.0);
  CHECK(fresnel(1.0f, into_ice) == relative(straight * straight, 1e-5));
  const double angle = std::atan(n), inside = 0.5 * std::numbers::pi - angle;
  const double across = std::sin(angle - inside) / std::sin(angle + inside);
  CHECK(fresnel(static_cast<float>(std::cos(angle)), into_ice) == relative(0.5 * across * across, 1e-5));
}

TEST_CASE("absorption over two ways one after the other is that over both together") {
  const vec3 one = transmittance(clear_ice_absorption_per_m, 2.0f),
             two = transmittance(clear_ice_absorption_per_m, 5.0f);
  CHECK(apart(one * two, transmittance(clear_ice_absorption_per_m, 7.0f)) < exact);
  CHECK(apart(transmittance(clear_ice_absorption_per_m, 0.0f), vec3(1.0f)) < exact);
  CHECK(one.r < one.g);
  CHECK(one.g < one.b);
}

}  // namespace septet::light

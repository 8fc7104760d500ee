/// Equations 1 to 4 of the paper, each against figures worked out by hand or against another law.

#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "engine/instant/ice_optics.hpp"
#include "tests/relative.hpp"

namespace septet::ice {
namespace {

constexpr double exact = 1e-6;

Vec3 any_direction(Random& random) { return glm::normalize(Vec3(random.normal(), random.normal(), random.normal())); }

double apart(const Vec3& a, const Vec3& b) { return glm::length(a - b); }

}  // namespace

TEST_CASE("equation 1 with the paper's share of 0.33 takes the back normal away as printed and adds it for a lens") {
  const Vec3 front(0, 0, 1), back(0.6, 0, -0.8);
  // 0.67 (0, 0, 1) − 0.33 (0.6, 0, −0.8) = (−0.198, 0, 0.934), of length 0.954756513.
  CHECK(apart(blended_normal(front, back), Vec3(-0.198, 0, 0.934) / 0.9547565134) < exact);
  // 0.67 (0, 0, 1) + 0.33 (0.6, 0, −0.8) = (0.198, 0, 0.406), of length 0.451707870.
  CHECK(apart(blended_normal(front, back, 0.33, BackSign::as_a_lens), Vec3(0.198, 0, 0.406) / 0.4517078702) < exact);
  CHECK(apart(blended_normal(front, back, 0.0), front) < exact);
  CHECK(apart(blended_normal(front, back, 1.0), -back) < exact);
  // Where the two cancel there is no direction: the front face's stays.
  CHECK(apart(blended_normal(front, front, 0.5), front) < exact);
}

TEST_CASE("equation 2 obeys Snell's law in the plane of incidence and gives a unit vector") {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 normal = any_direction(random);
    Vec3 eye = any_direction(random);
    if (glm::dot(eye, normal) > 0.0) eye = -eye;
    const auto refracted = refraction_vector(eye, normal, into_ice);
    REQUIRE(refracted.has_value());
    CHECK(std::abs(glm::length(*refracted) - 1.0) < exact);
    const double before = glm::length(glm::cross(eye, normal)), after = glm::length(glm::cross(*refracted, normal));
    CHECK(std::abs(air_index * before - ice_index * after) < exact);
    CHECK(std::abs(glm::dot(glm::cross(eye, normal), *refracted)) < exact);
  }
  // 45° in: sin = 0.70710678 · 1.0003 / 1.3091 = 0.54030931.
  const Vec3 refracted = *refraction_vector(glm::normalize(Vec3(1, 0, -1)), Vec3(0, 0, 1), into_ice);
  CHECK(apart(refracted, Vec3(0.54030931, 0, -0.84146649)) < exact);
}

TEST_CASE("light that meets the ice's face from within beyond 49.8 degrees is reflected wholly") {
  const double limit = std::asin(air_index / ice_index);
  CHECK(limit * 180.0 / 3.14159265358979 == relative(49.826, 1e-4));
  const auto within = [](double angle) { return Vec3(std::sin(angle), 0, -std::cos(angle)); };
  CHECK(refraction_vector(within(limit - 1e-6), Vec3(0, 0, 1), out_of_ice).has_value());
  CHECK(!refraction_vector(within(limit + 1e-6), Vec3(0, 0, 1), out_of_ice).has_value());
  CHECK(exact_fresnel_share(within(limit + 1e-6), Vec3(0, 0, 1), out_of_ice) == 1.0);
}

TEST_CASE("equation 3 keeps length and angle and turns back what comes from the front") {
  CHECK(apart(reflection_vector(Vec3(0.6, 0, -0.8), Vec3(0, 0, 1)), Vec3(0.6, 0, 0.8)) < exact);
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 normal = any_direction(random), eye = any_direction(random), mirrored = reflection_vector(eye, normal);
    CHECK(std::abs(glm::length(mirrored) - 1.0) < exact);
    CHECK(std::abs(glm::dot(mirrored, normal) + glm::dot(eye, normal)) < exact);
    CHECK(apart(reflection_vector(mirrored, normal), eye) < exact);
  }
}

TEST_CASE("equation 4 is none straight on, all at grazing, and an eighth at 60 degrees from either side") {
  const Vec3 normal(0, 0, 1);
  CHECK(std::abs(fresnel_share(Vec3(0, 0, -1), normal)) < exact);
  CHECK(std::abs(fresnel_share(Vec3(1, 0, 0), normal) - 1.0) < exact);
  const Vec3 sixty(std::sqrt(0.75), 0, -0.5);
  CHECK(std::abs(fresnel_share(sixty, normal) - 0.125) < exact);
  CHECK(std::abs(fresnel_share(sixty, -normal) - 0.125) < exact);
}

TEST_CASE("Fresnel's own equations give ((n - 1)/(n + 1))² straight on and one polarisation at Brewster's angle") {
  const double n = ice_index / air_index, straight = (n - 1.0) / (n + 1.0);
  CHECK(std::abs(exact_fresnel_share(Vec3(0, 0, -1), Vec3(0, 0, 1), into_ice) - straight * straight) < exact);
  const double angle = std::atan(n), refracted = 0.5 * 3.14159265358979 - angle;
  const double across = std::sin(angle - refracted) / std::sin(angle + refracted);
  CHECK(std::abs(exact_fresnel_share(Vec3(std::sin(angle), 0, -std::cos(angle)), Vec3(0, 0, 1), into_ice) -
                 0.5 * across * across) < exact);
}

TEST_CASE("absorption over two ways one after the other is that over both together") {
  const Vec3 one = transmittance(clear_ice_absorption_per_m, 2.0), two = transmittance(clear_ice_absorption_per_m, 5.0);
  CHECK(apart(one * two, transmittance(clear_ice_absorption_per_m, 7.0)) < exact);
  CHECK(apart(transmittance(clear_ice_absorption_per_m, 0.0), Vec3(1.0)) < exact);
  CHECK(one.r < one.g);
  CHECK(one.g < one.b);
}

}  // namespace septet::ice

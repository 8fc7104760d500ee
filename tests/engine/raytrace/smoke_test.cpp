#include "engine/raytrace/smoke.hpp"

#include <doctest/doctest.h>

#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {
namespace {

instant::SmokePuff puff(const Vec3& at_m, float radius_m, float area_m2, float albedo, float glow = 0.0f) {
  return {at_m, radius_m, area_m2, glm::vec3(albedo), glow, 0};
}

/// Even smoke from x = 2 to x = 5: puffs so close that their sum has no waves.
std::vector<instant::SmokePuff> slab(float extinction_per_m, float albedo) {
  std::vector<instant::SmokePuff> puffs;
  constexpr double apart_m = 0.25;
  for (int x = 0; x < 12; ++x)
    for (int y = -16; y < 16; ++y)
      for (int z = -16; z < 16; ++z)
        puffs.push_back(puff((Vec3(x, y, z) + 0.5) * apart_m + Vec3(2.0, 0.0, 0.0), 0.25f,
                             extinction_per_m * static_cast<float>(apart_m * apart_m * apart_m), albedo));
  return puffs;
}

Ray along_x(float y = 0.0f, float z = 0.0f) {
  Ray ray;
  ray.origin_m = {-3.0f, y, z};
  ray.direction = {1.0f, 0.0f, 0.0f};
  return ray;
}

instant::Instant in_smoke(std::vector<instant::SmokePuff> puffs, float sky) {
  instant::Instant instant = instant_from({-4.0, 0.0, 0.0}, 0.1, 24, even_sky(sky));
  instant.smoke = std::move(puffs);
  return instant;
}

scene::ResolvedScene nothing() { return {}; }

}  // namespace

TEST_CASE("a slab of smoke lets through what Beer and Lambert say") {
  for (const float extinction_per_m : {0.1f, 0.5f, 1.5f}) {
    const Smoke smoke(slab(extinction_per_m, 0.3f), Vec3(0.0));
    for (const float aside : {0.0f, 0.37f, -1.21f})
      CHECK(std::exp(-smoke.optical_depth(along_x(aside, 0.4f * aside))) ==
            relative(std::exp(-extinction_per_m * 3.0f), 0.005));
    // Slanted ray, through proportionally more of it.
    Ray aslant = along_x();
    aslant.direction = glm::normalize(glm::vec3(1.0f, 0.25f, -0.1f));
    aslant.origin_m = glm::vec3(3.5f, 0.0f, 0.0f) - 6.0f * aslant.direction;
    CHECK(smoke.optical_depth(aslant) == relative(extinction_per_m * 3.0f / aslant.direction.x, 0.005));
  }
}

TEST_CASE("puffs far apart dim what lies behind each as they do alone, and nothing between") {
  const instant::SmokePuff near = puff({3.0, 0.1, -0.2}, 1.0f, 2.0f, 0.3f),
                           far = puff({140.0, -60.0, 9.0}, 1.0f, 4.0f, 0.3f);
  const std::vector<instant::SmokePuff> both{near, far};
  const Smoke smoke(both, Vec3(0.0));
  const auto depth_through = [](const Smoke& in, const Vec3& middle_m) {
    Ray ray;
    ray.origin_m = glm::vec3(middle_m) - glm::vec3(0.0f, 8.0f, 0.0f);
    ray.direction = {0.0f, 1.0f, 0.0f};
    ray.to_m = 16.0f;
    return in.optical_depth(ray);
  };
  for (const instant::SmokePuff& one : both)
    CHECK(depth_through(smoke, one.position_m) ==
          relative(one.extinction_area_m2 / (2.0f * 3.14159265f * one.radius_m * one.radius_m), 0.1));
  CHECK(depth_through(smoke, {70.0, -30.0, 4.0}) == 0.0f);
}

TEST_CASE("a puff takes its extinction area from the light in all however fine the cells are") {
  for (const float radius_m : {0.3f, 1.0f}) {
    std::vector<instant::SmokePuff> puffs{puff({3.0, 0.1, -0.2}, radius_m, 2.0f, 0.3f)};
    const Smoke alone(puffs, Vec3(0.0));
    // A second one far away makes the cells coarse.
    puffs.push_back(puff({200.0, 60.0, 40.0}, radius_m, 1e-9f, 0.3f));
    const Smoke coarse(puffs, Vec3(0.0));
    CHECK(coarse.cell_m() > alone.cell_m());
    for (const Smoke* smoke : {&alone, &coarse}) {
      // Equal numbers of rays through every cell.
      double area = 0.0;
      const float step = smoke->cell_m() / 8.0f;
      for (float y = -6.0f; y < 6.0f; y += step)
        for (float z = -6.0f; z < 6.0f; z += step) area += double(smoke->optical_depth(along_x(y, z))) * step * step;
      CHECK(area == relative(2.0, 0.002));
    }
  }
}

TEST_CASE("depth adds up along a ray and is nothing before and behind the smoke") {
  const Smoke smoke(slab(0.7f, 0.3f), Vec3(0.0));
  Ray first = along_x(), second = along_x(), whole = along_x();
  first.to_m = second.from_m = 6.4f;
  CHECK(smoke.optical_depth(first) + smoke.optical_depth(second) == relative(smoke.optical_depth(whole), 1e-4));
  Ray before = along_x();
  before.to_m = 3.0f;
  CHECK(smoke.optical_depth(before) == 0.0f);
  Ray away = along_x();
  away.direction = -away.direction;
  CHECK(smoke.optical_depth(away) == 0.0f);
  CHECK_FALSE(smoke.walk(whole, 3.0f).scatters);
  const SmokeWalk walk = smoke.walk(whole, 0.7f * 1.5f);
  REQUIRE(walk.scatters);
  CHECK(walk.distance_m == relative(6.5, 0.005));
  CHECK(walk.albedo.x == relative(0.3, 1e-3));
}

TEST_CASE("smoke that only scatters cannot be told from the even sky around it") {
  const auto mean = mean_of(traced(nothing(), in_smoke({puff({3.0, 0.0, 0.0}, 1.0f, 12.0f, 1.0f)}, 0.25f),
                                   {.samples = 64, .paths = {.longest = 200, .roulette_from = 200}}));
  CHECK(mean.radiance.x == relative(0.25, 0.002));
}

TEST_CASE("black smoke hides what lies behind it and flames shine as bright as flames are") {
  const auto black = mean_of(traced(nothing(), in_smoke(slab(1.0f, 0.0f), 0.5f), {.samples = 256}));
  CHECK(std::abs(black.radiance.x - 0.5 * std::exp(-3.0)) < 4.0 * black.sigma + 0.005 * 0.5 * std::exp(-3.0));
  const auto flames =
      mean_of(traced(nothing(), in_smoke({puff({3.0, 0.0, 0.0}, 1.0f, 200.0f, 0.0f, 1.0f)}, 0.0f), {.samples = 4}));
  CHECK(flames.radiance.x == relative(double(instant::flame_radiance.x), 0.001));
  CHECK(flames.radiance.z == relative(double(instant::flame_radiance.z), 0.001));
}

TEST_CASE("the sun lights less of what lies in the shadow of smoke") {
  scene::SurfaceMaterial white;
  white.base_color = glm::vec3(0.8f);
  white.roughness = 1.0f;
  const scene::ResolvedScene ball = ball_scene(white, 3);
  const auto lit = [&](float extinction_per_m) {
    auto light = *even_sky(0.0f);
    light.light_direction = {1.0f, 0.0f, 0.0f};
    light.light_irradiance = glm::vec3(2.0f);
    // The sun stands beyond the slab; the eye looks at the side that it lights, from between.
    instant::Instant instant = instant_from({1.6, 0.0, 0.0}, 0.02, 8, std::make_shared<const instant::SkyLight>(light));
    instant.views.front().projection = instant::symmetric_view({1.6, 0.0, 0.0}, std::numbers::pi, 0.0, 0.02, 0.02);
    if (extinction_per_m > 0.0f) instant.smoke = slab(extinction_per_m, 0.0f);
    return mean_of(traced(ball, instant, {.samples = 64, .filter = Filter::box})).radiance.x;
  };
  // A little of the slab's edge lies between eye and ball too.
  const double share = lit(0.4f) / lit(0.0f);
  CHECK(share == relative(std::exp(-1.2), 0.02));
}

TEST_CASE("puffs that are nothing or nowhere are left out and a hall full of them keeps within its cells") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(Smoke(std::vector{puff({nan, 0.0, 0.0}, 1.0f, 1.0f, 0.5f), puff(Vec3(0.0), 1.0f, 0.0f, 0.5f),
                          puff(Vec3(0.0), 0.0f, 1.0f, 0.5f), puff(Vec3(1e300), 1.0f, 1.0f, 0.5f)},
              Vec3(0.0))
            .empty());
  const Smoke wide(std::vector{puff({-5000.0, 0.0, 0.0}, 0.1f, 1.0f, 0.5f), puff({5000.0, 1.0, 1.0}, 0.1f, 1.0f, 0.5f)},
                   Vec3(0.0));
  CHECK_FALSE(wide.empty());
  CHECK(std::isfinite(wide.optical_depth(along_x())));
}

}  // namespace septet::raytrace

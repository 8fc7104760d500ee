/// Coverings of glass, by paths; tests/engine/render/glass_slow_test.cpp has the rasteriser's.

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/ice/glass.hpp"
#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {
namespace {

constexpr std::uint32_t pane_px = 96;

/// Pane half a metre before the eye at the origin, upright, over the whole picture.
ice::PaneShape upright_pane() {
  return ice::pane_between({0.0, -0.7, -0.7}, {0.0, 0.7, -0.7}, {0.0, -0.7, 0.7}, {0.0, 0.7, 0.7}, 0.0);
}

ice::IceBody on_pane(std::vector<ice::IceVertex> surface, ice::OnGlass what) {
  ice::IceBody body;
  body.look.on_glass = what;
  body.origin_m = Vec3(0.5, 0.0, 0.0);
  body.vertices = std::move(surface);
  return body;
}

ice::IceBody even_frost(float kgpm2) {
  std::vector<ice::IceVertex> surface = ice::frost_surface(upright_pane(), ice::morning_frost(268.15, 1));
  for (ice::IceVertex& vertex : surface) vertex.rest_m.z = kgpm2;
  return on_pane(std::move(surface), ice::OnGlass::frost);
}

TracedPicture seen(const std::vector<ice::IceBody>& glass, std::shared_ptr<const instant::SkyLight> light) {
  instant::Instant instant = instant_from({0.0, 0.0, 0.0}, 1.2, pane_px, std::move(light));
  instant.glass = glass;
  return traced({}, instant, {.samples = 32, .filter = Filter::box});
}

}  // namespace

TEST_CASE("thick frost sends to either side the half of what falls on both, less what it keeps") {
  const ice::IceBody thick = even_frost(20.0f);  // Complete but for a few holes between the feathers.
  CHECK(mean_of(seen({thick}, even_sky(1.0f))).radiance.x == relative(0.88, 0.004));
  for (const float ahead : {1.0f, -1.0f}) {
    auto sun = *even_sky(0.0f);
    sun.light_direction = glm::normalize(glm::vec3(ahead, 0.3f, 1.4f));
    sun.light_irradiance = glm::vec3(3.0f);
    const double cosine = std::abs(double{sun.light_direction.x});
    const PictureMean mean = mean_of(seen({thick}, std::make_shared<const instant::SkyLight>(sun)));
    CHECK(mean.radiance.x == relative(0.44 * 3.0 * cosine / std::numbers::pi, 0.03));
  }
}

TEST_CASE("what lies behind thin frost is seen through it by Beer's law, and shadows are as thin") {
  for (const float kgpm2 : {0.02f, 0.05f, 0.1f, 0.2f}) {
    CAPTURE(kgpm2);
    const ice::IceBody frost = even_frost(kgpm2);
    const double kept = 1.0 - mean_of(seen({frost}, even_sky(1.0f))).radiance.x;
    const double clear = 1.0 - kept / 0.12, even = std::exp(-16.0 * double{kgpm2});
    // Feathers let through more than an even layer of their mass would.
    CHECK(clear >= even);
    CHECK(clear <= even + 0.2);
    // A second sheet behind it, thick, gets the transmitted sunlight and the light scattered on the path.
    auto sun = *even_sky(0.0f);
    sun.light_direction = glm::vec3(-1.0f, 0.0f, 0.0f);
    sun.light_irradiance = glm::vec3(1.0f);
    ice::IceBody screen = even_frost(20.0f), before = frost;
    before.origin_m.x = -0.5;  // Behind the eye.
    const auto light = std::make_shared<const instant::SkyLight>(sun);
    instant::Instant instant = instant_from({0.0, 0.0, 0.0}, 0.1, 32, light);
    instant.glass = {screen, before};
    const auto direct = traced({}, instant, {.samples = 128, .paths = {.longest = 2}, .filter = Filter::box});
    CHECK(mean_of(direct).radiance.x == relative(0.44 / std::numbers::pi * clear, 0.08));
  }
}

TEST_CASE("a star's cracks mirror the sky within the blow's reach, and beyond it no pixel changes") {
  const TracedPicture clear = seen({}, even_sky(1.0f));
  const ice::Star star{0.55, 0.45, 0.12, 5};
  const Vec3 middle = ice::place_on(upright_pane(), star.across, star.up);
  const TracedPicture cracked =
      seen({on_pane(ice::star_surface(upright_pane(), star), ice::OnGlass::cracks)}, even_sky(1.0f));
  int changed = 0, beyond = 0;
  for (std::uint32_t y = 0; y < pane_px; ++y)
    for (std::uint32_t x = 0; x < pane_px; ++x) {
      if (std::abs(cracked.at(x, y).radiance.x - clear.at(x, y).radiance.x) < 1e-4f) continue;
      const double tangent = std::tan(0.6) * 2.0 / pane_px;
      const double right = (x + 0.5 - 0.5 * pane_px) * tangent, up = (0.5 * pane_px - y - 0.5) * tangent;
      const double off_m = glm::length(Vec3(0.0, -0.5 * right - middle.y, 0.5 * up - middle.z));
      (off_m > star.reach_m + 0.01 ? beyond : changed) += 1;
    }
  CHECK(beyond == 0);
  CHECK(changed > 40);
  // Under an even sky no surface reflects more than it receives.
  CHECK(mean_of(cracked).radiance.x <= mean_of(clear).radiance.x * 1.0001);
  CHECK(mean_of(cracked).radiance.x > 0.97);
}

}  // namespace septet::raytrace

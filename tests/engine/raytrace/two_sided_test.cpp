/// Visible sides of a surface: the counterpart of tests/engine/render/two_sided_slow_test.cpp.

#include <doctest/doctest.h>

#include "engine/instant/instant.hpp"
#include "tests/engine/instant/two_sided_plate.hpp"
#include "tests/engine/raytrace/traced_scenes.hpp"

namespace septet::raytrace {
namespace {

glm::dvec3 seen(const instant::PlateLook& look, bool there = true) {
  const scene::ResolvedScene scene = instant::plate_scene(look, there);
  instant::FrameInput input;
  input.environment = instant::plate_day();
  input.views = {instant::plate_view(8)};
  const TracedPicture picture =
      traced(scene, instant::describe(input, instant::summarise(scene)), {.samples = 64, .seed = 3});
  glm::dvec3 sum(0.0);
  for (const std::size_t at : {27, 28, 35, 36}) sum += glm::dvec3(picture.pixels[at].radiance) / 4.0;
  return sum;
}

}  // namespace

TEST_CASE("the back of a plate is traced where its material is two-sided and is not there otherwise") {
  const glm::dvec3 behind = seen({}, false), front = seen({});
  CHECK(glm::length(seen({.from_behind = true}) - behind) < 0.02 * glm::length(behind));
  CHECK(glm::length(front - behind) > 0.05 * glm::length(behind));
  CHECK(glm::length(seen({.two_sided = true}) - front) < 0.05 * glm::length(front));
  CHECK(glm::length(seen({.two_sided = true, .from_behind = true}) - front) < 0.05 * glm::length(front));
  for (const instant::PlateLook look : {instant::PlateLook{.from_behind = true, .opacity = 0.5f},
                                        instant::PlateLook{.from_behind = true, .holes = true}})
    CHECK(glm::length(seen(look) - behind) > 0.02 * glm::length(behind));
}

}  // namespace septet::raytrace

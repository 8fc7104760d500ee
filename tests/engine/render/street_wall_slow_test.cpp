/// Light of sky and ground on a shaded wall along a street and on one in a field. Software device, validation layer on.

#include <cstdint>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/render/renderer.hpp"
#include "tests/engine/instant/two_sided_plate.hpp"
#include "tests/relative.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t wall_side_px = 64;

/// Radiance in the middle of a wall that faces away from the sun.
glm::vec3 shaded_wall(const Environment& day, bool in_street) {
  Renderer renderer =
      *Renderer::create({wall_side_px, wall_side_px, DevicePreference::software, true, Antialiasing::none, nullptr});
  scene::ResolvedScene scene = instant::plate_scene({}, true);
  scene.materials[0].base_color = glm::vec3(0.5f);
  scene.materials[0].in_street = in_street;
  REQUIRE(renderer.upload(scene).has_value());
  FrameInput input;
  input.environment = day;
  input.views = {instant::plate_view(wall_side_px)};
  REQUIRE(renderer.draw(input).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  return renderer.read_radiance()->at(wall_side_px / 2, wall_side_px / 2);
}

}  // namespace

TEST_CASE("a shaded wall along a street is drawn in the street's light and another in the open land's") {
  Environment day = instant::plate_day();
  day.sun_azimuth_rad = 0.5 * 3.14159265358979;  // Behind the wall.
  day.visibility_m = 200e3;
  const instant::SkyLight light = instant::sky_light(day);
  const glm::vec2 sun_level = glm::normalize(glm::vec2(light.sun_direction));
  const auto expected = [&](const instant::SkyIrradiance& terms) {
    return 0.5f / 3.14159265f * light::irradiance_on(terms.data(), sun_level, {-1.0f, 0.0f, 0.0f});
  };
  const glm::vec3 street = expected(light.street_irradiance), field = expected(light.irradiance);
  REQUIRE(street.r / street.b > 1.03f * (field.r / field.b));
  const glm::vec3 drawn_street = shaded_wall(day, true), drawn_field = shaded_wall(day, false);
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(drawn_street[c] == relative(street[c], 0.02));
    CHECK(drawn_field[c] == relative(field[c], 0.02));
  }
}

}  // namespace septet::render

/// Effects of weather and a roof on a drawn frame, read back from its pixels. Software device, validation layer on.

#include <cmath>
#include <cstdint>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/render/renderer.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/engine/render/studio.hpp"
#include "tests/relative.hpp"

namespace septet::render::studio_pictures {

TEST_CASE("shadows that nobody can see under clouds at dusk cost nothing and come back with the sun") {
  Studio studio;
  studio.input.participants = {reference_car(studio.reference, {14.0, -1.875, 0.02})};
  const image::Image sunny = studio.draw();
  CHECK(studio.renderer.statistics().shadow_triangles > 0);
  studio.input.environment.cloud_cover = 1.0;
  studio.input.environment.visibility_m = 3000.0;
  studio.input.environment.sun_elevation_rad = 0.05;
  CHECK(mean_difference(studio.draw(), sunny) > 1.0);
  CHECK(studio.renderer.statistics().shadow_triangles == 0);
  studio.input.environment = reference_day();
  CHECK(studio.draw() == sunny);
}

TEST_CASE("snow lies on the land and not on a car that drives nor on its windows") {
  Studio studio;
  studio.input.views[0].projection = symmetric_view({1.2, 0.35, 4.0}, 0.0, -0.5, 0.8, 0.5);
  studio.input.participants = {reference_car(studio.reference, {6.0, 0.0, 0.02})};
  const auto roof = pixel_of(studio.input.views[0], {7.2, 0.0, 1.4}),
             land = pixel_of(studio.input.views[0], {7.0, 3.0, 0.0});
  const auto around = [](const image::Image& picture, const glm::dvec2& at) {
    return level(mean(picture, static_cast<std::uint32_t>(at.x) - 3, static_cast<std::uint32_t>(at.y) - 3, 7, 7));
  };
  const image::Image bare = studio.draw();
  studio.input.environment.snow_cover = 1.0;
  const image::Image snowed = studio.draw();
  CHECK(around(snowed, land) > around(bare, land) + 30.0);
  CHECK(around(snowed, roof) == relative(around(bare, roof), 0.12));
}

TEST_CASE("rain darkens the near road and makes the far road mirror the sky") {
  Studio studio;
  studio.input.environment.cloud_cover = 1.0;
  const image::Image dry = studio.draw();
  studio.input.environment.road_wetness = 1.0;
  const image::Image wet = studio.draw();
  const auto row = static_cast<std::uint32_t>(pixel_of(studio.input.views[0], {90.0, -2.0, 0.0}).y);
  CHECK(level(mean(wet, 150, row, 20, 2)) > level(mean(dry, 150, row, 20, 2)));
  studio.input.views[0].projection = symmetric_view({1.2, 0.35, 1.2}, 0.0, -1.2, 0.8, 0.5);
  const image::Image wet_below = studio.draw();
  studio.input.environment.road_wetness = 0.0;
  CHECK(level(mean(wet_below, 0, 100, width, 100)) < level(mean(studio.draw(), 0, 100, width, 100)));
}

TEST_CASE("a wet road mirrors the lamps of a car ahead towards the eye and a dry one does not") {
  Studio studio;
  studio.input.environment.cloud_cover = 1.0;
  DrawnParticipant car = reference_car(studio.reference, {30.0, 0.35, 0.02});
  const auto more_red = [&](double wetness) {
    studio.input.environment.road_wetness = wetness;
    car.lamps.set(Lamp::brake, false);
    studio.input.participants = {car};
    const image::Image dark = studio.draw();
    car.lamps.set(Lamp::brake, true);
    studio.input.participants = {car};
    const Vec3 eye_m = world_eye(studio.input.views[0]), lamp_m(28.99, 1.0, 0.70);
    const auto place = pixel_of(studio.input.views[0], eye_m + (Vec3(lamp_m.x, lamp_m.y, -lamp_m.z) - eye_m) *
                                                                   (eye_m.z / (eye_m.z + lamp_m.z)));
    const auto x = static_cast<std::uint32_t>(place.x) - 2, y = static_cast<std::uint32_t>(place.y) - 2;
    return mean(studio.draw(), x, y, 5, 5).r - mean(dark, x, y, 5, 5).r;
  };
  CHECK(std::abs(more_red(0.0)) < 1.0);
  CHECK(more_red(1.0) > 8.0);
}

TEST_CASE("what falls is drawn before the eye in the open and nothing of it under a roof") {
  for (const bool tunnel : {false, true})
    for (const double temperature_k : {283.15, 268.15}) {
      Studio studio({{}, tunnel, 0});
      studio.input.environment.temperature_k = temperature_k;
      studio.input.views = {forward_view({tunnel ? 150.0 : 0.0, 0.0, 0.0}, width, height)};
      studio.input.views[0].velocity_mps = {25, 0, 0};
      const image::Image dry = studio.draw();
      // Rain, or a smaller amount of snow with the same visibility.
      studio.input.environment.rain_mm_per_h = temperature_k > 274.65 ? 10.0 : 0.8;
      const double change = mean_difference(dry, studio.draw());
      CAPTURE(tunnel);
      CAPTURE(temperature_k);
      CHECK((change > 0.01) == !tunnel);
      CHECK(change < 5.0);
    }
}

TEST_CASE("a tunnel keeps the sky out and dims the car in it") {
  Studio studio({{}, true, 0});
  // Same car, seen from the same distance behind it.
  const auto draw_at = [&](double x_m) {
    studio.input.participants = {reference_car(studio.reference, {x_m + 12.0, -1.875, 0.02})};
    studio.input.views = {forward_view({x_m, -1.875, 0.0}, width, height)};
    return studio.draw();
  };
  const image::Image outside = draw_at(0.0), inside = draw_at(180.0);
  const glm::dvec2 rear = pixel_of(studio.input.views[0], {192.0, -1.875, 0.7});
  const auto x = static_cast<std::uint32_t>(rear.x), y = static_cast<std::uint32_t>(rear.y);
  const auto car = [&](const image::Image& picture) { return mean(picture, x - 10, y - 4, 20, 8); };
  const auto above = [&](const image::Image& picture) { return mean(picture, 100, 0, 120, 10); };
  CAPTURE(level(car(outside)));
  CAPTURE(level(car(inside)));
  CHECK(level(car(inside)) < 0.7 * level(car(outside)));
  CHECK(level(car(inside)) > 5.0);  // Dim, but visible.
  CHECK(above(outside).b > above(outside).r + 20.0);
  CHECK(above(inside).b <= above(inside).r);
}

}  // namespace septet::render::studio_pictures

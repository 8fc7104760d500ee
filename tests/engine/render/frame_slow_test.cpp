/// Content of a drawn frame, read back from its pixels. Software device, validation layer on.

#include <cmath>
#include <functional>
#include <numeric>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/render/renderer.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/engine/render/studio.hpp"
#include "tests/relative.hpp"

namespace septet::render::studio_pictures {
namespace {

image::Image flipped(const image::Image& picture) {
  image::Image result(picture.width, picture.height);
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) result.set(picture.width - 1 - x, y, picture.at(x, y));
  return result;
}

}  // namespace

TEST_CASE("before the first frame the picture is black") {
  Studio studio;
  const image::Image picture = *studio.renderer.read_back();
  CHECK(level(mean(picture, 0, 0, width, height)) == 0.0);
}

TEST_CASE("by day the sky is blue and bright over a grey road and every pixel is opaque") {
  Studio studio;
  studio.input.environment.cloud_cover = 0.0;
  const image::Image picture = studio.draw();
  const glm::dvec3 sky = mean(picture, 0, 0, width, 40), road = mean(picture, 110, 170, 100, 25);
  CHECK(sky.b > sky.r + 20.0);
  CHECK(level(sky) > level(road));
  CHECK(std::abs(road.r - road.b) < 20.0);
  CHECK(level(road) > 30.0);
  CHECK(level(road) < 190.0);
  bool opaque = true;
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) opaque = opaque && picture.rgba[i] == 255;
  CHECK(opaque);
}

TEST_CASE("a car throws its shadow away from the sun and not towards it") {
  Studio studio;
  const Vec3 car_m(14.0, -1.875, 0.02);
  const image::Image without = studio.draw();
  studio.input.participants = {reference_car(studio.reference, car_m)};
  const image::Image with = studio.draw();
  // The sun stands at azimuth 3.9 (clockwise from north): its light runs to +x and +y.
  const Vec3 sun(std::sin(3.9) * std::cos(0.62), std::cos(3.9) * std::cos(0.62), std::sin(0.62));
  const Vec3 below = car_m + Vec3(0.6, 0.88, 0.6);
  const Vec3 shaded = below - sun * (0.6 / sun.z) + Vec3(0, -0.1, 0), lit = car_m + Vec3(0.6, -2.2, 0);
  const glm::dvec2 in = pixel_of(studio.input.views[0], shaded), out = pixel_of(studio.input.views[0], lit);
  const auto ratio = [&](const glm::dvec2& at) {
    const auto x = static_cast<std::uint32_t>(at.x), y = static_cast<std::uint32_t>(at.y);
    return level(mean(with, x - 1, y, 3, 1)) / level(mean(without, x - 1, y, 3, 1));
  };
  CHECK(ratio(in) < 0.75);
  CHECK(ratio(out) > 0.93);
}

TEST_CASE("the same input gives the same pixels in one renderer and in another") {
  Studio a({{}, false, 80}), b({{}, false, 80});
  for (Studio* studio : {&a, &b})
    for (int i = 0; i < 4; ++i)
      studio->input.participants.push_back(reference_car(studio->reference, {8.0 + 9.0 * i, 3.75 * (i % 3) - 4.0, 0}));
  const image::Image first = a.draw();
  a.input.views[0].world_from_car.position_m.x = 30.0;
  const image::Image other = a.draw();
  a.input.views[0].world_from_car.position_m.x = 0.0;
  CHECK(mean_difference(first, other) > 1.0);
  CHECK(a.draw() == first);
  CHECK(b.draw() == first);
}

TEST_CASE("the picture does not change when the whole world lies 100 km from its origin") {
  // A whole number of tiles of the clouds, but not of texels of the shadow map: only rounding may show.
  Studio near({{}, false, 0}), far({{100e3, -100e3, 60.0}, false, 0});
  near.input.environment.cloud_cover = far.input.environment.cloud_cover = 0.0;
  near.input.participants = {reference_car(near.reference, {12, 0, 0})};
  far.input.participants = {reference_car(far.reference, Vec3(100e3, -100e3, 60.0) + Vec3(12, 0, 0))};
  CHECK(mean_difference(near.draw(), far.draw()) < 0.3);
}

TEST_CASE("a brake lamp that lights changes the pixels at the lamp and not those far from it") {
  for (const bool night : {false, true}) {
    Studio studio;
    if (night) studio.input.environment.sun_elevation_rad = -0.3;
    studio.input.participants = {reference_car(studio.reference, {9.0, -1.875, 0.02})};
    const image::Image off = studio.draw();
    studio.input.participants[0].lamps.set(Lamp::brake, true);
    const image::Image on = studio.draw();
    const glm::dvec2 lamp = pixel_of(studio.input.views[0], {9.0 - 1.04, -1.875 + 0.65, 0.70});
    const auto x = static_cast<std::uint32_t>(lamp.x) - 2, y = static_cast<std::uint32_t>(lamp.y) - 2;
    CHECK(mean(on, x, y, 4, 4).r > mean(off, x, y, 4, 4).r + 15.0);
    CHECK(level(mean(on, 0, 0, width, 20)) == doctest::Approx(level(mean(off, 0, 0, width, 20))));
  }
}

TEST_CASE("a beacon flashes with simulated time") {
  Studio studio;
  studio.input.environment.sun_elevation_rad = -0.3;
  studio.input.participants = {reference_car(studio.reference, {20.0, -1.875, 0.02})};
  studio.input.participants[0].lamps.set(Lamp::beacon, true);
  studio.input.simulated_time_s = 0.03;
  const image::Image flash = studio.draw();
  studio.input.simulated_time_s = 0.09;
  const image::Image pause = studio.draw();
  CHECK(mean_difference(flash, pause) > 0.2);
}

TEST_CASE("headlights light the road at night") {
  Studio studio;
  studio.input.environment.sun_elevation_rad = -0.3;
  DrawnParticipant own = reference_car(studio.reference, {0, 0, 0});
  own.shown = Shown::shadow_and_light;
  studio.input.participants = {own};
  const double dark = level(mean(studio.draw(), 130, 130, 60, 30));
  studio.input.participants[0].lamps.set(Lamp::low_beam, true);
  const double lit = level(mean(studio.draw(), 130, 130, 60, 30));
  CHECK(dark < 30.0);
  CHECK(lit > dark + 30.0);
}

TEST_CASE("headlights light nothing by day under a closed cover") {
  Studio studio;
  studio.input.environment.cloud_cover = 1.0;
  DrawnParticipant own = reference_car(studio.reference, {0, 0, 0});
  own.shown = Shown::shadow_and_light;
  studio.input.participants = {own};
  const image::Image without = studio.draw();
  studio.input.participants[0].lamps.set(Lamp::low_beam, true);
  CHECK(mean_difference(without, studio.draw()) < 0.05);
}

TEST_CASE("a near headlamp dazzles with its lens and not with a disc a metre wide and a far one is still seen") {
  Studio studio;
  studio.input.environment.sun_elevation_rad = -0.3;
  for (const double distance_m : {8.0, 300.0}) {
    DrawnParticipant car = reference_car(studio.reference, {distance_m, 1.9, 0.02});
    car.world_from_vehicle.orientation = orientation_from_angles(3.14159265, 0.0, 0.0);
    car.lamps.set(Lamp::low_beam, true);
    studio.input.participants = {car};
    const image::Image picture = studio.draw();
    int white = 0;
    double brightest = 0.0;
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x) {
        const double here = level(mean(picture, x, y, 1, 1));
        white += here > 235.0;
        brightest = std::max(brightest, here);
      }
    const auto across = [&](double y_m) { return pixel_of(studio.input.views[0], {distance_m - 3.7, y_m, 0.6}).x; };
    const double pixels_per_m = across(1.0) - across(2.0), white_m2 = white / (pixels_per_m * pixels_per_m);
    CAPTURE(distance_m);
    CAPTURE(white_m2);
    CHECK(brightest > 150.0);
    if (distance_m < 10.0) CHECK(white_m2 < 0.35);  // Two lenses and the white around them.
  }
}

TEST_CASE("a mirror shows the view with left and right exchanged") {
  for (const Antialiasing antialiasing : {Antialiasing::none, Antialiasing::multisampled}) {
    Studio studio({{}, false, 60}, antialiasing);
    studio.input.participants = {reference_car(studio.reference, {12.0, 2.0, 0.0})};
    const image::Image direct = studio.draw();
    studio.input.views[0].mirrored = true;
    const image::Image mirrored = studio.draw();
    CHECK(mean_difference(direct, mirrored) > 2.0);
    CHECK(mean_difference(flipped(direct), mirrored) < 1.0);
  }
}

TEST_CASE("an inset lies over the first view and leaves the rest of the picture as it was") {
  Studio studio;
  const image::Image plain = studio.draw();
  FrameView mirror = forward_view({0, 0, 0}, 100, 40);
  mirror.projection = symmetric_view({1.2, 0.0, 1.3}, M_PI, 0.0, 0.6, 0.25);
  mirror.viewport = {200, 10, 100, 40};
  mirror.mirrored = true;
  studio.input.views.push_back(mirror);
  const image::Image with = studio.draw();
  CHECK(level(mean(with, 0, 60, width, 140)) == doctest::Approx(level(mean(plain, 0, 60, width, 140))));
  double changed = 0.0;
  for (std::uint32_t y = 12; y < 48; ++y)
    for (std::uint32_t x = 202; x < 298; ++x) changed += !(with.at(x, y) == plain.at(x, y));
  CHECK(changed > 0.5 * 96 * 36);
}

TEST_CASE("a line of text stands in its box and is gone with the next frame") {
  Studio studio;
  const image::Image plain = studio.draw();
  studio.input.overlay = {{.text = "server lost",
                           .x_px = 160,
                           .y_px = 100,
                           .height_px = 24,
                           .background = {0.6f, 0, 0, 1},
                           .centered = true}};
  const image::Image with = studio.draw();
  const glm::dvec3 box = mean(with, 110, 92, 100, 16);
  CHECK(box.r > box.g + 40.0);
  double white = 0.0;
  for (std::uint32_t y = 90; y < 110; ++y)
    for (std::uint32_t x = 90; x < 230; ++x) white += with.at(x, y).green > 200;
  CHECK(white > 100.0);
  CHECK(level(mean(with, 0, 130, width, 70)) == doctest::Approx(level(mean(plain, 0, 130, width, 70))));
  studio.input.overlay.clear();
  CHECK(studio.draw() == plain);
}

TEST_CASE("only what has a new revision is uploaded again") {
  Studio studio;
  const image::Image before = studio.draw();
  // A changed image with its old revision is ignored; with a new one it shows.
  for (std::uint8_t& code : studio.reference.scene.images[0].rgba) code = 255;
  studio.reference.scene.revision = 2;
  REQUIRE(studio.renderer.upload(studio.reference.scene).has_value());
  CHECK(studio.draw() == before);
  studio.reference.scene.images[0].revision = 2;
  studio.reference.scene.revision = 3;
  REQUIRE(studio.renderer.upload(studio.reference.scene).has_value());
  CHECK(level(mean(studio.draw(), 110, 170, 100, 25)) > level(mean(before, 110, 170, 100, 25)) + 30.0);
}

TEST_CASE("a scene that points outside itself is drawn without what makes no sense") {
  Studio studio;
  scene::ResolvedScene broken = studio.reference.scene;
  broken.revision = 2;
  for (scene::SurfaceMesh& mesh : broken.meshes) mesh.revision = 2;
  broken.meshes[0].indices[4] = 1u << 30;
  broken.meshes[1].parts[0].index_count = 0xfffffff0u;
  broken.meshes[2].parts[0].material = 999;
  broken.instances[0].mesh = 77777;
  broken.materials[0].base_color_image = 500;
  broken.images[1].width = 7;
  broken.images[1].revision = 2;
  broken.prototypes[0].parts[0].mesh = 9999;
  REQUIRE(studio.renderer.upload(broken).has_value());
  studio.input.participants = {reference_car(studio.reference, {10, 0, 0})};
  studio.input.participants.push_back(studio.input.participants[0]);
  studio.input.participants[1].prototype = 77;
  studio.draw();
  broken = {};
  broken.revision = 3;
  REQUIRE(studio.renderer.upload(broken).has_value());
  studio.draw();
}

TEST_CASE("a picture of no size is refused with a message") {
  const auto none = Renderer::create({0, 200, DevicePreference::software, false, Antialiasing::automatic, nullptr});
  REQUIRE_FALSE(none.has_value());
  CHECK(none.error().what == "the picture is 0 × 200 pixels");
}

TEST_CASE("the picture takes another size") {
  Studio studio;
  studio.draw();
  REQUIRE(studio.renderer.resize(200, 120).has_value());
  studio.input.views = {forward_view({0, 0, 0}, 200, 120)};
  const image::Image picture = studio.draw();
  CHECK(picture.width == 200);
  CHECK(picture.height == 120);
  CHECK(level(mean(picture, 0, 0, 200, 20)) > 40.0);
}

}  // namespace septet::render::studio_pictures

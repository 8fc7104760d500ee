/// What a drawn frame shows, read back from its pixels. Software device, validation layer on.

#include <cmath>
#include <functional>
#include <numeric>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/render/renderer.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/relative.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t width = 320, height = 200;

struct Studio {
  Renderer renderer;
  ReferenceScene reference;
  FrameInput input;

  explicit Studio(const ReferenceOptions& options = {{}, false, 0}, Antialiasing antialiasing = Antialiasing::automatic)
      : renderer(*Renderer::create({width, height, DevicePreference::software, true, antialiasing, nullptr})),
        reference(reference_scene(options)) {
    REQUIRE(renderer.upload(reference.scene).has_value());
    input.environment = reference_day();
    input.views = {forward_view(options.origin_m, width, height)};
  }
  ~Studio() {
    CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  }
  image::Image draw() {
    REQUIRE(renderer.draw(input).has_value());
    return *renderer.read_back();
  }
};

/// Mean colour of a rectangle, codes 0 to 255.
glm::dvec3 mean(const image::Image& picture, std::uint32_t x, std::uint32_t y, std::uint32_t w, std::uint32_t h) {
  glm::dvec3 sum(0.0);
  for (std::uint32_t j = y; j < y + h; ++j)
    for (std::uint32_t i = x; i < x + w; ++i) {
      const image::Color c = picture.at(i, j);
      sum += glm::dvec3(c.red, c.green, c.blue);
    }
  return sum / (double(w) * h);
}

double level(const glm::dvec3& color) { return (color.r + color.g + color.b) / 3.0; }

double mean_difference(const image::Image& a, const image::Image& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(int(a.rgba[i]) - int(b.rgba[i]));
  return sum / static_cast<double>(a.rgba.size());
}

image::Image flipped(const image::Image& picture) {
  image::Image result(picture.width, picture.height);
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) result.set(picture.width - 1 - x, y, picture.at(x, y));
  return result;
}

/// Where a world point falls in the picture, pixels.
glm::dvec2 pixel_of(const FrameView& view, const Vec3& world_m) {
  const Vec3 car_m = inverse(view.world_from_car) * world_m;
  const glm::dvec4 clip = view.projection.clip_from_eye_relative * glm::dvec4(car_m - view.projection.eye_m, 1.0);
  return {(0.5 + 0.5 * clip.x / clip.w) * view.viewport.width, (0.5 + 0.5 * clip.y / clip.w) * view.viewport.height};
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
  // A whole number of the cloud tile and of no texel of the shadow map: only rounding may show.
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
    if (distance_m < 10.0) CHECK(white_m2 < 0.35);  // Two lenses and what is white around them.
  }
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
      // Rain or, as hard to see through, less of snow.
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
  // The same car, seen from as far behind it.
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
  CHECK(level(car(inside)) > 5.0);  // It is dim, not gone.
  CHECK(above(outside).b > above(outside).r + 20.0);
  CHECK(above(inside).b <= above(inside).r);
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
  // A changed image with its old revision is not looked at; with a new one it shows.
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

}  // namespace septet::render

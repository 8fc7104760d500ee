/// Size of the glow of a vehicle's lamps in a picture, by its distance.
///
/// A glow is light that the eye scatters: as large as the lamp's own (participants.cpp) until that is a few pixels, and
/// from there on no smaller but dimmer (shaders/glow.vert). Its light is that of its lamp, which falls with the square
/// of the distance from where the lens itself is no longer seen (passes/glow_pass.hpp).

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/instant/scene_summary.hpp"
#include "engine/render/renderer.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/world/vehicle_model.hpp"
#include "tests/relative.hpp"

namespace septet {
namespace {

/// Pixels as those of a screen of 1080 lines over 40 degrees.
constexpr std::uint32_t glow_side_px = 192;
constexpr double glow_pixel_rad = 1.0 / 1484.0;

struct SeenGlow {
  double area_px = 0.0;    ///< Of pixels with more than a hundredth of its brightest one's light.
  double light = 0.0;      ///< Of all pixels.
  double brightest = 0.0;  ///< Pixel.
};

enum class From : std::uint8_t { behind, ahead };

/// Of the lamps of a car, seen by night: the picture with their glows less that without.
SeenGlow glow_of_lamps(render::Renderer& renderer, const scene::ResolvedScene& scene, double distance_m,
                       From from = From::behind, bool main_beam = false) {
  instant::FrameInput input;
  input.environment.sun_elevation_rad = -0.4;
  input.environment.sun_illuminance_lux = 0.0;
  input.environment.visibility_m = 200e3;
  instant::FrameView view;
  const double across_rad = 2.0 * std::atan(0.5 * glow_side_px * glow_pixel_rad);
  view.projection = instant::symmetric_view({0.0, 0.0, 0.8}, 0.0, 0.0, across_rad, across_rad);
  view.viewport = {0, 0, glow_side_px, glow_side_px};
  input.views = {view};
  Participant car{.id = 1, .model = *find_vehicle_model("saloon")};
  const VehicleModel& model = vehicle_models()[car.model];
  car.world_from_vehicle.position_m = {distance_m + model.rear_overhang_m, 0.0, 0.0};
  if (from == From::ahead) {
    // In the lane beside.
    car.world_from_vehicle.position_m = {distance_m + model.rear_overhang_m, 3.5, 0.0};
    car.world_from_vehicle.orientation = orientation_from_angles(std::numbers::pi, 0.0, 0.0);
  }
  car.lamps.set(Lamp::low_beam, true);
  car.lamps.set(Lamp::high_beam, main_beam);
  const auto prototype = std::ranges::find(scene.prototypes, model.name, &scene::Prototype::name);
  REQUIRE(prototype != scene.prototypes.end());
  input.participants = {
      instant::drawn_participant(car, static_cast<std::uint32_t>(prototype - scene.prototypes.begin()))};
  instant::Instant instant = instant::describe(input, instant::summarise(scene));
  REQUIRE(!instant.lamps.empty());
  REQUIRE(renderer.draw(instant).has_value());
  const render::RadianceImage with = *renderer.read_radiance();
  instant.lamps.clear();
  REQUIRE(renderer.draw(instant).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  const render::RadianceImage without = *renderer.read_radiance();
  std::vector<double> more;
  SeenGlow seen;
  for (std::size_t i = 0; i < with.radiance.size(); ++i) {
    more.push_back(double(with.radiance[i].r - without.radiance[i].r));
    seen.light += more.back();
    seen.brightest = std::max(seen.brightest, more.back());
  }
  for (const double each : more) seen.area_px += each > 0.01 * seen.brightest;
  return seen;
}

}  // namespace

/// A renderer that has the vehicles' scene.
struct GlowScreen {
  scene::ResolvedScene scene;
  render::Renderer renderer;

  static GlowScreen with_vehicles() {
    scene::Store store;
    scene::SceneBuilder builder(store);
    scenery::build_vehicles(builder);
    GlowScreen screen{scene::resolve(store),
                      *render::Renderer::create({glow_side_px, glow_side_px, render::DevicePreference::software, true,
                                                 render::Antialiasing::none, nullptr})};
    REQUIRE(screen.renderer.upload(screen.scene).has_value());
    return screen;
  }
};

TEST_CASE(
    "by night the glow of tail lamps takes up an area that falls with the square of the distance until it is a few "
    "pixels wide and its light goes on falling so to four hundred metres") {
  GlowScreen screen = GlowScreen::with_vehicles();
  const auto seen = [&](double distance_m) { return glow_of_lamps(screen.renderer, screen.scene, distance_m); };
  // The two lamps' glows; a hundredth of the light is left at the root of 0.231 of the radius, 0.22 m times 1.9 by
  // night.
  const auto area_px = [](double distance_m) {
    const double radius_px = std::max(0.418 / (distance_m * glow_pixel_rad), 3.2);
    return 2.0 * std::numbers::pi * 0.231 * radius_px * radius_px;
  };
  const SeenGlow reference = seen(100.0);
  SeenGlow nearer{1e9, 1e9, 1e9};
  for (const double distance_m : {25.0, 35.0, 50.0, 70.0, 100.0, 140.0, 200.0, 400.0}) {
    const SeenGlow glow = seen(distance_m);
    CAPTURE(distance_m);
    CAPTURE(glow.area_px);
    CAPTURE(area_px(distance_m));
    CAPTURE(glow.light);
    if (distance_m <= 140.0) CHECK(glow.area_px == relative(area_px(distance_m), 0.1));
    CHECK(glow.area_px <= 1.1 * nearer.area_px);
    if (distance_m >= 50.0) {
      CHECK(glow.light * distance_m * distance_m == relative(reference.light * 1e4, 0.1));
      CHECK(glow.light < nearer.light);
    }
    nearer = glow;
  }
}

TEST_CASE("an oncoming main beam dazzles: its glow is several times as large and as bright as a dipped beam's") {
  GlowScreen screen = GlowScreen::with_vehicles();
  for (const double distance_m : {50.0, 100.0, 200.0, 400.0}) {
    CAPTURE(distance_m);
    const SeenGlow dipped = glow_of_lamps(screen.renderer, screen.scene, distance_m, From::ahead),
                   main = glow_of_lamps(screen.renderer, screen.scene, distance_m, From::ahead, true);
    CAPTURE(dipped.area_px);
    CAPTURE(main.area_px);
    CHECK(main.brightest > 4.0 * dipped.brightest);
    CHECK(main.light > 15.0 * dipped.light);
    if (distance_m <= 100.0) CHECK(main.area_px > 2.0 * dipped.area_px);
  }
}

}  // namespace septet

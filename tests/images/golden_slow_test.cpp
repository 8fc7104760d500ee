/// What fixed instants on the scenario's motorway look like, compared with the pictures in golden/ (see the README there).

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "engine/road/road_position.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "engine/world/paint.hpp"
#include "engine/world/vehicle_model.hpp"
#include "tests/engine/road/road_files.hpp"

namespace septet {
namespace {

constexpr std::uint32_t width = 320, height = 210;

struct Instant {
  const char* name;
  double s_m;
  double heading_deg;
  bool night, rain;
};

class Motorway {
 public:
  Motorway() {
    scene::Store store;
    scene::SceneBuilder builder(store);
    scenery::build_vehicles(builder);
    scenery::build_road_world(builder, road::motorway(), 1);
    scene_ = scene::resolve(store);
  }
  const scene::ResolvedScene& scene() const { return scene_; }

  instant::FrameInput frame(const Instant& instant) const {
    instant::FrameInput input;
    input.simulated_time_s = 12.0;
    if (instant.rain) {
      input.environment.rain_mm_per_h = 6.0;
      input.environment.road_wetness = 0.8;
      input.environment.cloud_cover = 1.0;
      input.environment.visibility_m = 3000.0;
    }
    if (instant.night) {
      input.environment.sun_elevation_rad = -0.4;
      input.environment.sun_illuminance_lux = 0.0;
    }
    instant::FrameView view;
    view.projection = instant::symmetric_view(Vec3(1.35, 0.37, 1.17), instant.heading_deg * std::numbers::pi / 180.0,
                                              0.0, 0.77, 0.52);
    view.world_from_car = in_lane(-3, instant.s_m);
    view.viewport = {0, 0, width, height};
    input.views.push_back(view);
    for (std::size_t i = 0; i < 14; ++i) {
      // Some ahead of the eye and some behind it, in all lanes but its own nearby.
      const double ahead_m = (i % 2 == 0 ? 14.0 : -16.0) + (i % 2 == 0 ? 9.0 : -9.0) * static_cast<double>(i);
      const auto& models = vehicle_models();
      Participant participant;
      participant.model = static_cast<ModelIndex>(i % models.size());
      if (models[participant.model].kind == ParticipantKind::pedestrian) continue;
      participant.paint = static_cast<std::uint8_t>(i);
      participant.world_from_vehicle = in_lane(-2 - static_cast<int>((i * 2 + 2) % 5), instant.s_m + ahead_m);
      participant.wheel_spin_rad = 0.4;
      participant.lamps.set(Lamp::low_beam, instant.night || instant.rain);
      participant.lamps.set(Lamp::brake, i % 4 == 0);
      participant.lamps.set(Lamp::beacon, models[participant.model].kind == ParticipantKind::ambulance);
      input.participants.push_back(instant::drawn_participant(participant, prototype(models[participant.model].name)));
    }
    instant::DrawnParticipant own;  // The driver's car gives its light and its shadow.
    own.prototype = prototype("volvo-s80");
    own.world_from_vehicle = view.world_from_car;
    own.lamps.set(Lamp::low_beam, instant.night);
    own.shown = instant::Shown::shadow_and_light;
    input.participants.push_back(own);
    return input;
  }

 private:
  RigidTransform in_lane(int lane, double s_m) const {
    return road::world_from_lane(road::evaluate_lane(road::motorway(), {0, lane, s_m, 0.0}));
  }
  std::uint32_t prototype(std::string_view name) const {
    const auto found = std::ranges::find(scene_.prototypes, name, &scene::Prototype::name);
    REQUIRE(found != scene_.prototypes.end());
    return static_cast<std::uint32_t>(found - scene_.prototypes.begin());
  }

  scene::ResolvedScene scene_;
};

struct Difference {
  double mean = 0.0;         ///< Of the three colours, in steps of 255.
  double largest_1pc = 0.0;  ///< One pixel in a hundred differs by more.
  image::Image picture;      ///< Fourfold, on grey.
};

Difference difference(const image::Image& a, const image::Image& b) {
  Difference result;
  result.picture = image::Image(a.width, a.height);
  std::vector<int> worst;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int most = 0;
    for (std::size_t c = i; c < i + 3; ++c) {
      const int d = int{a.rgba[c]} - int{b.rgba[c]};
      most = std::max(most, std::abs(d));
      result.mean += std::abs(d);
      result.picture.rgba[c] = static_cast<std::uint8_t>(std::clamp(128 + 4 * d, 0, 255));
    }
    worst.push_back(most);
  }
  result.mean /= 3.0 * static_cast<double>(worst.size());
  const auto rank = worst.begin() + static_cast<std::ptrdiff_t>(worst.size() * 99 / 100);
  std::nth_element(worst.begin(), rank, worst.end());
  result.largest_1pc = *rank;
  return result;
}

}  // namespace

TEST_CASE(
    "the motorway looks as its golden pictures by day and in the tunnel at noon and at night and behind and on a rainy "
    "night") {
  namespace fs = std::filesystem;
  const fs::path golden = fs::path(SEPTET_SOURCE_DIR) / "tests/images/golden",
                 made = fs::path(SEPTET_BINARY_DIR) / "images";
  fs::create_directories(made);
  const bool renew = std::getenv("SEPTET_RENEW_IMAGES") != nullptr;
  const Motorway motorway;
  auto renderer = render::Renderer::create(
      {width, height, render::DevicePreference::software, false, render::Antialiasing::automatic, nullptr});
  REQUIRE(renderer.has_value());
  REQUIRE(renderer->upload(motorway.scene()).has_value());
  for (const Instant& instant :
       {Instant{"day-ahead", 800.0, 0.0, false, false}, Instant{"tunnel", 3350.0, 0.0, false, false},
        Instant{"tunnel-night", 3350.0, 0.0, true, false}, Instant{"rear", 800.0, 165.0, false, false},
        Instant{"night-rain", 2400.0, 0.0, true, true}}) {
    CAPTURE(instant.name);
    REQUIRE(renderer->draw(motorway.frame(instant)).has_value());
    CHECK(renderer->statistics().triangles < 100'000);
    const auto picture = renderer->read_back();
    REQUIRE(picture.has_value());
    const std::string file = std::string(instant.name) + ".png";
    if (renew) REQUIRE(image::write_png(golden / file, *picture).has_value());
    const auto expected = image::read_png(golden / file);
    REQUIRE(expected.has_value());
    REQUIRE(expected->width == width);
    REQUIRE(expected->height == height);
    const Difference differs = difference(*picture, *expected);
    INFO("mean " << differs.mean << ", one pixel in a hundred by more than " << differs.largest_1pc << " of 255; see "
                 << made.string());
    const bool same = differs.mean < 1.0 && differs.largest_1pc < 24.0;
    CHECK(same);
    if (same) continue;
    CHECK(image::write_png(made / ("golden-" + file), *picture).has_value());
    CHECK(image::write_png(made / ("golden-difference-" + file), differs.picture).has_value());
  }
}

}  // namespace septet

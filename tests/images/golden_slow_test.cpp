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

/// Mean difference of the three colours in steps of 255 that a tile may have. One in which an edge fell on the next pixel stays
/// below it, one from which a car is missing does not.
constexpr double accepted = 8.0;
constexpr std::uint32_t tile_px = 16;

struct Difference {
  double mean = 0.0;           ///< Of the whole picture.
  double worst = 0.0;          ///< Of the tile that differs most.
  std::uint32_t x = 0, y = 0;  ///< Where that tile begins.
  bool is_same() const { return mean < 1.0 && worst < accepted; }
};

Difference difference(const image::Image& a, const image::Image& b) {
  // Mean over a rectangle.
  const auto over = [&](std::uint32_t left, std::uint32_t top, std::uint32_t wide, std::uint32_t high) {
    double sum = 0.0;
    for (std::uint32_t y = top; y < top + high; ++y)
      for (std::uint32_t x = left; x < left + wide; ++x) {
        const image::Color in_a = a.at(x, y), in_b = b.at(x, y);
        sum += std::abs(in_a.red - in_b.red) + std::abs(in_a.green - in_b.green) + std::abs(in_a.blue - in_b.blue);
      }
    return sum / (3.0 * wide * high);
  };
  Difference result;
  result.mean = over(0, 0, a.width, a.height);
  // The last tiles of rows and columns overlap their neighbours: each has its full size.
  for (std::uint32_t row = 0; row < a.height; row += tile_px)
    for (std::uint32_t column = 0; column < a.width; column += tile_px) {
      const std::uint32_t x = std::min(column, a.width - tile_px), y = std::min(row, a.height - tile_px);
      const double mean = over(x, y, tile_px, tile_px);
      if (mean <= result.worst) continue;
      result.worst = mean;
      result.x = x;
      result.y = y;
    }
  return result;
}

/// The difference fourfold, on grey.
image::Image difference_picture(const image::Image& a, const image::Image& b) {
  image::Image picture(a.width, a.height);
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    if (i % 4 != 3) picture.rgba[i] = static_cast<std::uint8_t>(std::clamp(128 + 4 * (a.rgba[i] - b.rgba[i]), 0, 255));
  return picture;
}

/// Draws the motorway.
class Studio {
 public:
  Studio()
      : renderer_(*render::Renderer::create(
            {width, height, render::DevicePreference::software, false, render::Antialiasing::automatic, nullptr})) {
    REQUIRE(renderer_.upload(motorway_.scene()).has_value());
  }
  const Motorway& motorway() const { return motorway_; }
  image::Image draw(const instant::FrameInput& input) {
    REQUIRE(renderer_.draw(input).has_value());
    CHECK(renderer_.statistics().triangles < 100'000);
    const auto picture = renderer_.read_back();
    REQUIRE(picture.has_value());
    return *picture;
  }

 private:
  Motorway motorway_;
  render::Renderer renderer_;
};

constexpr Instant day_ahead{"day-ahead", 800.0, 0.0, false, false};

}  // namespace

TEST_CASE(
    "the motorway looks as its golden pictures by day and in the tunnel at noon and at night and behind and on a rainy "
    "night") {
  namespace fs = std::filesystem;
  const fs::path golden = fs::path(SEPTET_SOURCE_DIR) / "tests/images/golden",
                 made = fs::path(SEPTET_BINARY_DIR) / "images";
  fs::create_directories(made);
  const bool renew = std::getenv("SEPTET_RENEW_IMAGES") != nullptr;
  Studio studio;
  for (const Instant& instant :
       {day_ahead, Instant{"tunnel", 3350.0, 0.0, false, false}, Instant{"tunnel-night", 3350.0, 0.0, true, false},
        Instant{"rear", 800.0, 165.0, false, false}, Instant{"night-rain", 2400.0, 0.0, true, true}}) {
    CAPTURE(instant.name);
    const image::Image picture = studio.draw(studio.motorway().frame(instant));
    const std::string file = std::string(instant.name) + ".png";
    if (renew) REQUIRE(image::write_png(golden / file, picture).has_value());
    const auto expected = image::read_png(golden / file);
    REQUIRE(expected.has_value());
    REQUIRE(expected->width == width);
    REQUIRE(expected->height == height);
    const Difference differs = difference(picture, *expected);
    INFO("mean " << differs.mean << ", " << differs.worst << " of 255 in the tile at " << differs.x << ", " << differs.y
                 << "; see " << made.string());
    CHECK(differs.is_same());
    if (differs.is_same()) continue;
    CHECK(image::write_png(made / ("golden-" + file), picture).has_value());
    CHECK(image::write_png(made / ("golden-difference-" + file), difference_picture(picture, *expected)).has_value());
  }
}

TEST_CASE("a picture from which one vehicle is missing is not the golden one") {
  constexpr long least_px = 100;  // What can be seen as a vehicle.
  Studio studio;
  const instant::FrameInput all = studio.motorway().frame(day_ahead);
  const image::Image whole = studio.draw(all);
  int seen = 0;
  for (std::size_t i = 0; i + 1 < all.participants.size(); ++i) {  // The last one is the driver's car.
    CAPTURE(i);
    instant::FrameInput others = all;
    others.participants.erase(others.participants.begin() + static_cast<std::ptrdiff_t>(i));
    const image::Image picture = studio.draw(others);
    long changed_px = 0;
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x) changed_px += !(picture.at(x, y) == whole.at(x, y));
    if (changed_px < least_px) continue;
    ++seen;
    const Difference differs = difference(picture, whole);
    CAPTURE(changed_px);
    CAPTURE(differs.mean);
    CAPTURE(differs.worst);
    CHECK_FALSE(differs.is_same());
  }
  CHECK(seen >= 3);
}

}  // namespace septet

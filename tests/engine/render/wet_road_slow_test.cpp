/// Pictures of a wet road, measured.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/image/png.hpp"
#include "engine/instant/clouds.hpp"
#include "engine/instant/wet_road.hpp"
#include "engine/light/wet_road.hpp"
#include "engine/render/renderer.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/relative.hpp"

namespace septet::render::wet_road_pictures {
namespace {

constexpr std::uint32_t width = 320, height = 210;
constexpr double across_rad = 1.05;

struct Drawing {
  Renderer renderer;
  ReferenceScene reference;

  static Drawing make(const Vec3& origin_m = Vec3(0.0)) {
    Expected<Renderer> renderer =
        Renderer::create({width, height, DevicePreference::software, true, Antialiasing::none, nullptr});
    REQUIRE(renderer.has_value());
    ReferenceOptions options;
    options.trees = 0;
    options.origin_m = origin_m;
    Drawing drawing{std::move(*renderer), reference_scene(options)};
    REQUIRE(drawing.renderer.upload(drawing.reference.scene).has_value());
    return drawing;
  }

  RadianceImage draw(const FrameInput& input, const std::string& name = {}) {
    REQUIRE(renderer.draw(input).has_value());
    if (!name.empty()) {
      const std::filesystem::path folder = std::filesystem::path(build_folder()) / "images";
      std::filesystem::create_directories(folder);
      CHECK(image::write_png(folder / (name + ".png"), *renderer.read_back()).has_value());
    }
    CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
    return *renderer.read_radiance();
  }
};

Environment overcast(double wetness, double rain_mm_per_h = 0.0) {
  Environment environment = reference_day();
  environment.cloud_cover = 1.0;
  environment.road_wetness = wetness;
  environment.rain_mm_per_h = rain_mm_per_h;
  return environment;
}

/// A car of which only the shadow and the light are drawn stands around the eye: the road is below it.
FrameInput ahead(const Drawing& drawing, const Environment& environment) {
  FrameInput input;
  input.environment = environment;
  input.simulated_time_s = 3.0;
  input.views = {forward_view({0, -1.875, 0.02}, width, height)};
  DrawnParticipant own = reference_car(drawing.reference, {0, -1.875, 0.02});
  own.shown = Shown::shadow_and_light;
  input.participants = {own};
  return input;
}

/// Pixel of a place of the world.
std::pair<double, double> pixel_of(const FrameInput& input, const Vec3& place_m) {
  const Vec3 from_eye = place_m - world_eye(input.views[0]);
  const double scale = 0.5 * width / std::tan(0.5 * across_rad) / from_eye.x;
  return {0.5 * width - from_eye.y * scale, 0.5 * height - from_eye.z * scale};
}

glm::dvec3 mean_around(const RadianceImage& picture, std::pair<double, double> at, int half_px) {
  glm::dvec3 sum(0.0);
  int count = 0;
  for (int y = static_cast<int>(at.second) - half_px; y <= static_cast<int>(at.second) + half_px; ++y)
    for (int x = static_cast<int>(at.first) - half_px; x <= static_cast<int>(at.first) + half_px; ++x, ++count)
      sum += glm::dvec3(picture.radiance[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)]);
  return sum / double(count);
}

/// Change of a frame's light by a car added in this lane, under this name for its picture.
struct WithoutAndWith {
  FrameInput input;  ///< Frame with the car.
  RadianceImage without, with;
};
WithoutAndWith add_car(Drawing& drawing, const Environment& environment, double ahead_m, const std::string& name = {}) {
  FrameInput input = ahead(drawing, environment);
  RadianceImage without = drawing.draw(input);
  input.participants.push_back(reference_car(drawing.reference, {ahead_m, -1.875, 0.02}));
  return {input, std::move(without), drawing.draw(input, name)};
}

/// Red light of the brake lamps of one more car in this lane, by pixel from the row on where the road is seen at
/// `from_m`; row by row.
std::vector<std::vector<double>> brake_light(Drawing& drawing, FrameInput input, double ahead_m, double from_m,
                                             const std::string& name) {
  DrawnParticipant car = reference_car(drawing.reference, {ahead_m, -1.875, 0.02});
  input.participants.push_back(car);
  const RadianceImage unlit = drawing.draw(input);
  input.participants.back().lamps.set(Lamp::brake, true);
  const RadianceImage lit = drawing.draw(input, name);
  std::vector<std::vector<double>> rows;
  for (auto y = static_cast<std::uint32_t>(pixel_of(input, {from_m, 0.0, 0.0}).second); y < height; ++y) {
    std::vector<double>& row = rows.emplace_back();
    for (std::uint32_t x = 0; x < width; ++x) row.push_back(double(lit.at(x, y).r) - double(unlit.at(x, y).r));
  }
  return rows;
}

/// Difference of the upper tenth of the pixels of the road before the eye, beside their mean. Streaks of rain cover
/// fewer.
double moved(const RadianceImage& a, const RadianceImage& b) {
  std::vector<double> away;
  double sum = 0.0;
  for (std::size_t y = height * 7 / 10; y < height; ++y)
    for (std::size_t x = width / 3; x < width * 2 / 3; ++x) {
      const double one = a.radiance[y * width + x].g, other = b.radiance[y * width + x].g;
      sum += one;
      away.push_back(std::abs(one - other));
    }
  std::ranges::sort(away);
  return away[away.size() * 9 / 10] * static_cast<double>(away.size()) / sum;
}

/// Place along x with the most water on the road 3 to 8 m ahead of an eye there.
Vec3 most_puddles() {
  const std::vector<std::uint8_t> noise = instant::cloud_noise();
  double most = -1.0;
  Vec3 place_m(0.0);
  for (double from_m = 0.0; from_m < light::puddle_tile_m; from_m += 1.0) {
    double sum = 0.0;
    for (double x_m = 3.0; x_m < 8.0; x_m += 0.5)
      for (double y_m = -1.5; y_m < 1.5; y_m += 0.5) sum += instant::puddle(noise, from_m + x_m, y_m - 1.5, 0.0f, 1.0f);
    if (sum > most) most = sum, place_m = {from_m, 0.0, 0.0};
  }
  REQUIRE(most > 10.0);
  return place_m;
}

}  // namespace

TEST_CASE("a wet road shows a car upside down below it, as bright as water mirrors it, and a dry one does not") {
  Drawing drawing = Drawing::make();
  const double car_x_m = 21.0;
  for (const double wetness : {0.0, 0.5}) {
    const auto [with, empty, full] = add_car(drawing, overcast(wetness), car_x_m, wetness > 0.0 ? "wet_mirror" : "");
    // The back of the body, and its mirror image on the road before it.
    const Vec3 back_m(car_x_m - 1.0, -1.875, 0.02 + 0.62), image_m(car_x_m - 1.0, -1.875, 0.02 - 0.62);
    const auto at = pixel_of(with, image_m);
    const glm::dvec3 body = mean_around(full, pixel_of(with, back_m), 2), sky = mean_around(empty, {160.0, 8.0}, 3);
    const glm::dvec3 added = mean_around(full, at, 1) - mean_around(empty, at, 1);
    const double height_m = world_eye(with.views[0]).z - 0.02;
    const double way_m = (car_x_m - 1.0 - 1.2) * height_m / (height_m + 0.62);
    const double cosine = height_m / std::hypot(height_m, way_m);
    const double fresnel = 0.02 + 0.98 * std::pow(1.0 - cosine, 5.0);
    INFO("wetness ", wetness, ": added ", added.r, ' ', added.g, ' ', added.b, ", body ", body.r, ' ', body.g, ", sky ",
         sky.g, ", fresnel ", fresnel);
    if (wetness == 0.0) {
      CHECK(std::abs(added.g) < 0.01 * mean_around(empty, at, 1).g);
    } else {
      // The formerly mirrored sky is replaced by the body, which is red.
      CHECK(added.g < 0.0);
      CHECK(added.r > added.g);
      CHECK((added.r - added.g) / (fresnel * 0.36 * wetness * (body.r - body.g)) == relative(1.0, 0.3));
    }
  }
}

TEST_CASE("snow that lies on a wet road mirrors nothing") {
  Drawing drawing = Drawing::make();
  const auto mirrored = [&](double snow_cover) {
    Environment environment = overcast(0.5);
    environment.snow_cover = snow_cover;
    const auto [with, empty, full] = add_car(drawing, environment, 21.0);
    const auto at = pixel_of(with, {20.0, -1.875, 0.02 - 0.62});
    const glm::dvec3 added = mean_around(full, at, 1) - mean_around(empty, at, 1);
    return added.r - added.g;
  };
  const double wet = mirrored(0.0), snowed = mirrored(1.0);
  CAPTURE(wet);
  CHECK(wet > 0.0);
  CHECK(std::abs(snowed) < 0.15 * wet);
}

TEST_CASE("a gantry is mirrored by the wet road before it") {
  Drawing drawing = Drawing::make();
  FrameInput input = ahead(drawing, overcast(1.0));
  const RadianceImage with = drawing.draw(input, "wet_gantry");
  input.participants.clear();  // Without participants on the road its place is unknown.
  const RadianceImage without = drawing.draw(input);
  // Its sign hangs 5.2 to 7.6 m over the road, 45 m ahead.
  const auto at = pixel_of(input, {44.7, -2.0, -6.4});
  CHECK(mean_around(with, at, 2).g < 0.97 * mean_around(without, at, 2).g);
}

TEST_CASE("a lamp sends no streak over the road before what hides it, and one over all of it where nothing does") {
  Drawing drawing = Drawing::make();
  const auto streak = [&](bool hidden) {
    FrameInput input = ahead(drawing, overcast(1.0));
    input.environment.sun_elevation_rad = -0.3;
    if (hidden) input.participants.push_back(reference_car(drawing.reference, {20.0, -1.875, 0.02}));
    double sum = 0.0;
    for (const auto& row : brake_light(drawing, input, 45.0, 17.0, hidden ? "hidden_lamp" : "shown_lamp"))
      sum += std::accumulate(row.begin(), row.end(), 0.0);
    return sum;
  };
  const double shown = streak(false), hidden = streak(true);
  CAPTURE(shown);
  CAPTURE(hidden);
  CHECK(shown > 0.0);
  CHECK(std::abs(hidden) < 0.01 * shown);
}

TEST_CASE("the film on a wet road shows a lens once, drawn out and not in copies") {
  Drawing drawing = Drawing::make();
  FrameInput input = ahead(drawing, overcast(0.45));
  input.environment.sun_elevation_rad = -0.3;
  const auto rows = brake_light(drawing, input, 21.0, 19.0, "one_lens");
  // Brightest column.
  std::vector<double> column;
  for (std::uint32_t x = 0; x < width; ++x) {
    std::vector<double> here;
    here.reserve(rows.size());
    for (const auto& row : rows) here.push_back(row[x]);
    if (column.empty() || *std::ranges::max_element(here) > *std::ranges::max_element(column)) column = here;
  }
  const double brightest = *std::ranges::max_element(column);
  REQUIRE(brightest > 0.0);
  // Number of peaks: falls after a rise, each by more than a twentieth of the brightest.
  int peaks = 0;
  double lowest = 0.0, highest = 0.0;
  bool rises = true;
  for (const double light : column) {
    if (rises) {
      highest = std::max(highest, light);
      if (light < highest - 0.05 * brightest) ++peaks, rises = false, lowest = light;
    } else {
      lowest = std::min(lowest, light);
      if (light > lowest + 0.05 * brightest) rises = true, highest = light;
    }
  }
  CHECK(peaks == 1);
}

TEST_CASE("rain rings the puddles, more of them the harder it rains, and moves them with simulated time") {
  const Vec3 origin_m = most_puddles();
  Drawing drawing = Drawing::make(origin_m);
  std::vector<double> movement;
  for (const double rain : {0.0, 2.0, 40.0}) {
    FrameInput input = ahead(drawing, overcast(1.0, rain));
    input.environment.temperature_k = 283.0;
    input.views[0].world_from_car.position_m += origin_m;
    input.participants[0].world_from_vehicle.position_m += origin_m;
    const RadianceImage before = drawing.draw(input, rain == 40.0 ? "ripples" : "");
    CHECK(before.radiance == drawing.draw(input).radiance);
    input.simulated_time_s += 0.1;
    movement.push_back(moved(before, drawing.draw(input)));
  }
  INFO("moved ", movement[0], ' ', movement[1], ' ', movement[2]);
  CHECK(movement[0] < 1e-4);
  CHECK(movement[1] > 0.002);
  CHECK(movement[2] > 1.3 * movement[1]);
}

TEST_CASE("straight from above and under clouds, wet asphalt is 0.4 to 0.7 as bright as dry") {
  Drawing drawing = Drawing::make();
  double means[2]{};
  for (const double wetness : {0.0, 1.0}) {
    FrameInput input = ahead(drawing, overcast(wetness));
    input.views[0].projection = symmetric_view({-4.0, 0.9, 6.0}, 0.0, -1.55, 0.6, 0.4);
    const RadianceImage picture = drawing.draw(input);
    means[wetness > 0.0] = mean_around(picture, {160.0, 105.0}, 40).g;
  }
  INFO("wet ", means[1], " dry ", means[0]);
  CHECK(means[1] / means[0] > 0.4);
  CHECK(means[1] / means[0] < 0.7);
}

}  // namespace septet::render::wet_road_pictures

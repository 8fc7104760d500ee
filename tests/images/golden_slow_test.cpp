/// What fixed instants on the scenario's motorway look like, compared with the pictures in golden/ (see the README there).

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "tests/images/flip.hpp"
#include "tests/images/motorway_view.hpp"

namespace septet {
namespace {

constexpr std::uint32_t width = motorway_width_px, height = motorway_height_px;

/// Mean FLIP that the whole and a tile may have. A tile in which an edge fell on the next pixel stays below it, one from which a car is missing does not.
constexpr double accepted_mean = 0.01, accepted_tile = 0.12;
constexpr std::uint32_t tile_px = 16;

struct Difference {
  double mean = 0.0;           ///< Of the whole picture.
  double worst = 0.0;          ///< Of the tile that differs most.
  std::uint32_t x = 0, y = 0;  ///< Where that tile begins.
  bool is_same() const { return mean < accepted_mean && worst < accepted_tile; }
};

Difference difference(const FlipFeatures& a, const FlipFeatures& b) {
  const std::vector<float> flips = flip(a, b);
  // Mean over a rectangle.
  const auto over = [&](std::uint32_t left, std::uint32_t top, std::uint32_t wide, std::uint32_t high) {
    double sum = 0.0;
    for (std::uint32_t y = top; y < top + high; ++y)
      for (std::uint32_t x = left; x < left + wide; ++x) sum += double{flips[std::size_t{y} * a.width + x]};
    return sum / (double{1.0} * wide * high);
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

constexpr MotorwayInstant day_ahead{"day-ahead", 800.0, 0.0, false, false};

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
  for (const MotorwayInstant& instant :
       {day_ahead, MotorwayInstant{"tunnel", 3350.0, 0.0, false, false},
        MotorwayInstant{"tunnel-night", 3350.0, 0.0, true, false}, MotorwayInstant{"rear", 800.0, 165.0, false, false},
        MotorwayInstant{"night-rain", 2400.0, 0.0, true, true}}) {
    CAPTURE(instant.name);
    const image::Image picture = studio.draw(studio.motorway().frame(instant));
    const std::string file = std::string(instant.name) + ".png";
    if (renew) REQUIRE(image::write_png(golden / file, picture).has_value());
    const auto expected = image::read_png(golden / file);
    REQUIRE(expected.has_value());
    REQUIRE(expected->width == width);
    REQUIRE(expected->height == height);
    const Difference differs = difference(flip_features(*expected), flip_features(picture));
    INFO("mean FLIP " << differs.mean << ", " << differs.worst << " in the tile at " << differs.x << ", " << differs.y
                      << "; see " << made.string());
    CHECK(differs.is_same());
    if (differs.is_same()) continue;
    CHECK(image::write_png(made / ("golden-" + file), picture).has_value());
    CHECK(image::write_png(made / ("golden-difference-" + file), difference_picture(picture, *expected)).has_value());
  }
}

TEST_CASE("pictures alike differ by nothing, white and black by nearly all, and an edge on the next pixel by little") {
  image::Image black(64, 48), white(64, 48), edge(64, 48), next(64, 48);
  for (std::uint32_t y = 0; y < 48; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) {
      black.set(x, y, {0, 0, 0});
      white.set(x, y, {255, 255, 255});
      edge.set(x, y, x < 32 ? image::Color{60, 60, 60} : image::Color{90, 90, 90});
      next.set(x, y, x < 33 ? image::Color{60, 60, 60} : image::Color{90, 90, 90});
    }
  CHECK(difference(flip_features(edge), flip_features(edge)).mean == doctest::Approx(0.0));
  // As flip.py has it.
  CHECK(difference(flip_features(black), flip_features(white)).mean == doctest::Approx(0.9674).epsilon(2e-3));
  const Difference moved = difference(flip_features(edge), flip_features(next));
  CHECK(moved.mean == doctest::Approx(0.01016).epsilon(0.02));
  CHECK(moved.worst < 0.5 * accepted_tile);
}

TEST_CASE("a picture from which one vehicle is missing is not the golden one") {
  constexpr long least_px = 100;  // What can be seen as a vehicle.
  Studio studio;
  const instant::FrameInput all = studio.motorway().frame(day_ahead);
  const image::Image whole = studio.draw(all);
  const FlipFeatures of_whole = flip_features(whole);
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
    const Difference differs = difference(of_whole, flip_features(picture));
    CAPTURE(changed_px);
    CAPTURE(differs.mean);
    CAPTURE(differs.worst);
    CHECK_FALSE(differs.is_same());
  }
  CHECK(seen >= 3);
}

}  // namespace septet

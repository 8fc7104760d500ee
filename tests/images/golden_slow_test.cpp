/// Screens at fixed instants on the scenario's motorway, compared with the pictures in golden/ (see the README there).
/// They are drawn as septet-screen draws them: a snapshot, through a screen of a shipped rig.

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
#include "engine/rig/rig.hpp"
#include "sim-client/frame/screen_frames.hpp"
#include "tests/checkout.hpp"
#include "tests/images/flip.hpp"
#include "tests/images/motorway_view.hpp"
#include "tests/relative.hpp"
#include "tests/shipped_files.hpp"

namespace septet {
namespace {

/// Mean FLIP that the whole and a tile may have. A tile in which an edge fell on the next pixel stays below it, one
/// from which a car is missing does not.
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

/// A screen of a shipped rig, of fewer pixels.
struct SmallScreen {
  std::string rig, name;
  std::uint32_t width_px, height_px;
  std::uint32_t most_triangles = 100'000;
};

const SmallScreen in_the_cockpit{"desktop", "desktop", 384, 224, 200'000};
const SmallScreen left_of_it{"three-monitors", "left", 384, 216, 200'000};
const SmallScreen ahead{"seven-screens", "ahead-3", 320, 229};
const SmallScreen behind{"seven-screens", "behind-right", 224, 232};

/// One screen of the rig, as its client draws it.
class Client {
 public:
  Client(const Motorway& motorway, const SmallScreen& screen)
      : motorway_(motorway),
        most_triangles_(screen.most_triangles),
        rig_(*rig::read_rig(shipped_text("rigs/" + screen.rig + ".toml"), screen.rig)),
        renderer_(
            *render::Renderer::create({screen.width_px, screen.height_px, render::DevicePreference::software, false})) {
    const auto found = std::ranges::find(rig_.screens, screen.name, &rig::Screen::name);
    REQUIRE(found != rig_.screens.end());
    found->width_px = screen.width_px;
    found->height_px = screen.height_px;
    REQUIRE(frames_.look_through(rig_, *found).has_value());
    REQUIRE(renderer_.upload(motorway_.scene()).has_value());
  }
  image::Image draw(const Snapshot& shown) {
    frames_.show(shown, {}, 1.0 / 120.0, motorway_.scene());
    REQUIRE(renderer_.draw(frames_.frame(shown, motorway_.scene())).has_value());
    CHECK(renderer_.statistics().triangles < most_triangles_);
    const auto picture = renderer_.read_back();
    REQUIRE(picture.has_value());
    return *picture;
  }

 private:
  const Motorway& motorway_;
  std::uint32_t most_triangles_;
  rig::Rig rig_;
  frame::ScreenFrames frames_;
  render::Renderer renderer_;
};

constexpr double driven_mps = 25.0;
constexpr MotorwayInstant by_day{"day-ahead", 800.0, 0.0, false, false};

}  // namespace

TEST_CASE(
    "a client's screens show the motorway as on its golden pictures, from the cockpit by day, left of it in the tunnel "
    "at "
    "noon, ahead at night, behind, and from the cockpit on a rainy night") {
  namespace fs = std::filesystem;
  const fs::path golden = fs::path(source_folder()) / "tests/images/golden", made = fs::path(build_folder()) / "images";
  fs::create_directories(made);
  const bool renew = std::getenv("SEPTET_RENEW_IMAGES") != nullptr;
  const Motorway motorway;
  struct Golden {
    MotorwayInstant instant;
    const SmallScreen& screen;
  };
  for (const Golden& each : {Golden{by_day, in_the_cockpit},
                             {{"tunnel", 3350.0, 0.0, false, false}, left_of_it},
                             {{"tunnel-night", 3350.0, 0.0, true, false}, ahead},
                             {{"rear", 800.0, 0.0, false, false}, behind},
                             {{"night-rain", 2400.0, 0.0, true, true}, in_the_cockpit}}) {
    CAPTURE(each.instant.name);
    Client client(motorway, each.screen);
    const image::Image picture = client.draw(motorway.snapshot(each.instant, driven_mps));
    const std::string file = std::string(each.instant.name) + ".png";
    if (renew) REQUIRE(image::write_png(golden / file, picture).has_value());
    const auto expected = image::read_png(golden / file);
    REQUIRE(expected.has_value());
    REQUIRE(expected->width == picture.width);
    REQUIRE(expected->height == picture.height);
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
  // As in flip.py.
  CHECK(difference(flip_features(black), flip_features(white)).mean == relative(0.9674, 2e-3));
  const Difference moved = difference(flip_features(edge), flip_features(next));
  CHECK(moved.mean == relative(0.01016, 0.02));
  CHECK(moved.worst < 0.5 * accepted_tile);
}

TEST_CASE("a picture from which one vehicle is missing is not the golden one") {
  constexpr long least_px = 100;  // Visible as a vehicle.
  const Motorway motorway;
  Client client(motorway, ahead);
  const Snapshot all = motorway.snapshot(by_day, driven_mps);
  const image::Image whole = client.draw(all);
  const FlipFeatures of_whole = flip_features(whole);
  int seen = 0;
  for (std::size_t i = 0; i + 1 < all.participants.size(); ++i) {  // The last one is the driver's car.
    CAPTURE(i);
    Snapshot others = all;
    others.participants.erase(others.participants.begin() + static_cast<std::ptrdiff_t>(i));
    const image::Image picture = client.draw(others);
    long changed_px = 0;
    for (std::uint32_t y = 0; y < whole.height; ++y)
      for (std::uint32_t x = 0; x < whole.width; ++x) changed_px += !(picture.at(x, y) == whole.at(x, y));
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

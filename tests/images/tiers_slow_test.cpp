/// A graphics card's extra effects change no cue that a driver acts on: lamps, lines, signs and places of vehicles,
/// measured in pictures of a screen with and without it. Software device, on request.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "tests/images/motorway_view.hpp"
#include "tests/relative.hpp"

namespace septet {
namespace {

constexpr std::uint32_t wide_px = 480, high_px = 315;

struct Tier {
  const char* name;
  render::RendererOptions options;
};

std::array<Tier, 3> tiers() {
  render::RendererOptions plain{.width = wide_px,
                                .height = high_px,
                                .device = render::DevicePreference::software,
                                .validation = true,
                                .antialiasing = render::Antialiasing::smoothing,
                                .bloom = render::Bloom::none,
                                .shadow_edges = render::ShadowEdges::narrow,
                                .headlights = render::Headlights::nearest};
  render::RendererOptions soft = plain, clustered = plain;
  soft.shadow_edges = render::ShadowEdges::soft;
  clustered.headlights = render::Headlights::clustered;
  return {Tier{"plain", plain}, {"soft shadows", soft}, {"clustered headlights", clustered}};
}

class TierScreen {
 public:
  TierScreen(const Motorway& motorway, const Tier& tier)
      : name_(tier.name), renderer_(*render::Renderer::create(tier.options)) {
    REQUIRE(renderer_.upload(motorway.scene()).has_value());
  }
  image::Image draw(const instant::FrameInput& input, const std::string& what) {
    REQUIRE(renderer_.draw(input).has_value());
    CHECK_MESSAGE(renderer_.statistics().validation_messages == 0, renderer_.statistics().first_validation_message);
    const image::Image picture = *renderer_.read_back();
    if (const char* folder = std::getenv("SEPTET_PICTURES"))
      CHECK(image::write_png(std::string(folder) + "/tiers-" + what + " " + name_ + ".png", picture).has_value());
    return picture;
  }

 private:
  std::string name_;
  render::Renderer renderer_;
};

/// Region in which two pictures differ visibly. Its bounds are where they differ plainly: by half of a shadow's depth
/// or more, where a wide edge of a shadow has its middle.
struct Change {
  double codes = 0.0;  ///< By which they differ, all pixels and colours together.
  glm::dvec2 middle{0.0};
  std::uint32_t left = wide_px, right = 0, top = high_px, bottom = 0;
};
Change change(const image::Image& with, const image::Image& without) {
  constexpr int overlooked = 12, plain = 45;
  Change result;
  for (std::uint32_t y = 0; y < high_px; ++y)
    for (std::uint32_t x = 0; x < wide_px; ++x) {
      const image::Color a = with.at(x, y), b = without.at(x, y);
      const int red = std::abs(a.red - b.red), green = std::abs(a.green - b.green), blue = std::abs(a.blue - b.blue);
      if (std::max({red, green, blue}) <= overlooked) continue;
      const double codes = red + green + blue;
      result.codes += codes;
      result.middle += codes * glm::dvec2(x, y);
      if (std::max({red, green, blue}) <= plain) continue;
      result.left = std::min(result.left, x);
      result.right = std::max(result.right, x);
      result.top = std::min(result.top, y);
      result.bottom = std::max(result.bottom, y);
    }
  if (result.codes > 0.0) result.middle /= result.codes;
  return result;
}

/// A shadow that tapers off may end two pixels earlier.
bool is_beside(std::uint32_t a, std::uint32_t b) { return a <= b + 2 && b <= a + 2; }

instant::FrameInput seen(const Motorway& motorway, const MotorwayInstant& instant) {
  instant::FrameInput input = motorway.frame(instant);
  input.views[0].viewport = {0, 0, wide_px, high_px};
  return input;
}

constexpr MotorwayInstant at_noon{"noon", 800.0, 0.0, false, false}, rainy_night{"night", 2400.0, 0.0, true, true};

}  // namespace

TEST_CASE(
    "softer shadows and clustered headlights leave each vehicle where it is, and brake lamps as bright within 2 %") {
  const Motorway motorway;
  for (const MotorwayInstant& instant : {at_noon, rainy_night}) {
    CAPTURE(instant.name);
    const instant::FrameInput all = seen(motorway, instant);
    std::array<Change, 3> car, brakes;
    for (std::size_t i = 0; i < 3; ++i) {
      TierScreen screen(motorway, tiers()[i]);
      // The nearest vehicle ahead.
      instant::FrameInput dark = all, braking = all, gone = all;
      dark.participants[0].lamps.set(Lamp::brake, false);
      braking.participants[0].lamps.set(Lamp::brake, true);
      gone.participants.erase(gone.participants.begin());
      const image::Image unlit = screen.draw(dark, std::string(instant.name) + " unlit");
      car[i] = change(unlit, screen.draw(gone, std::string(instant.name) + " gone"));
      brakes[i] = change(screen.draw(braking, std::string(instant.name) + " braking"), unlit);
    }
    REQUIRE(car[0].codes > 10'000.0);
    REQUIRE(car[0].left + 20 < car[0].right);
    REQUIRE(brakes[0].codes > 300.0);
    for (const std::size_t i : {1u, 2u}) {
      CAPTURE(tiers()[i].name);
      CHECK(brakes[i].codes == relative(brakes[0].codes, 0.02));
      CHECK(glm::distance(brakes[i].middle, brakes[0].middle) < 0.3);
      CHECK(glm::distance(car[i].middle, car[0].middle) < 1.0);
      CHECK(is_beside(car[i].left, car[0].left));
      CHECK(is_beside(car[i].right, car[0].right));
      CHECK(is_beside(car[i].top, car[0].top));
      CHECK(is_beside(car[i].bottom, car[0].bottom));
    }
  }
}

TEST_CASE("softer shadows and clustered headlights leave lines and what is written on signs their contrast") {
  const Motorway motorway;
  for (const MotorwayInstant& instant : {at_noon, rainy_night}) {
    CAPTURE(instant.name);
    instant::FrameInput empty = seen(motorway, instant);
    empty.participants.erase(empty.participants.begin(), empty.participants.end() - 1);
    empty.environment.sun_elevation_rad = instant.night ? empty.environment.sun_elevation_rad : 1.3;
    std::array<image::Image, 3> pictures;
    for (std::size_t i = 0; i < 3; ++i)
      pictures[i] = TierScreen(motorway, tiers()[i]).draw(empty, std::string(instant.name) + " empty");
    // Obvious steps from a pixel to the next: edges of lines, letters, borders of signs.
    const int plain = instant.night ? 12 : 30;
    const auto step = [](const image::Image& picture, std::uint32_t x, std::uint32_t y) {
      return picture.at(x + 1, y).green - picture.at(x, y).green;
    };
    for (const std::size_t i : {1u, 2u}) {
      CAPTURE(tiers()[i].name);
      int steps = 0, kept = 0;
      for (std::uint32_t y = 0; y < high_px; ++y)
        for (std::uint32_t x = 0; x + 1 < wide_px; ++x) {
          const int before = step(pictures[0], x, y);
          if (std::abs(before) < plain) continue;
          ++steps;
          kept += std::abs(step(pictures[i], x, y) - before) <= std::max(2, std::abs(before) / 20);
        }
      CAPTURE(steps);
      CAPTURE(kept);
      CHECK(steps > 300);
      CHECK(kept >= 0.97 * steps);
    }
  }
}

}  // namespace septet

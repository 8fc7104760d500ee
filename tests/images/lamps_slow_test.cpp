/// Lamps' visibility to the driver by day, measured in pictures of a screen.

#include <array>
#include <cstdint>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "engine/image/image.hpp"
#include "engine/render/renderer.hpp"
#include "tests/images/lab.hpp"
#include "tests/images/motorway_view.hpp"

namespace septet {
namespace {

struct Screen {
  std::uint32_t width_px, height_px;
  double across_rad, up_rad;
  int least_px;  ///< That must differ.
};

/// A car on the road ahead, seen from the driver's seat.
instant::FrameInput car_ahead(const Motorway& motorway, const Screen& screen, double ahead_m) {
  instant::FrameInput input = motorway.frame({"lamps", 800.0, 0.0, false, false});
  input.views[0].viewport = {0, 0, screen.width_px, screen.height_px};
  input.views[0].projection =
      instant::symmetric_view(Vec3(1.35, 0.37, 1.17), 0.0, 0.0, screen.across_rad, screen.up_rad);
  const RigidTransform place =
      motorway.frame({"its place", 800.0 + ahead_m, 0.0, false, false}).views[0].world_from_car;
  input.participants.resize(1);
  input.participants[0].world_from_vehicle = place;
  input.participants[0].lamps = {};
  return input;
}

}  // namespace

TEST_CASE(
    "at noon a car that brakes a hundred metres ahead is told by its colour from one that has its tail lamps lit, in "
    "any paint, in the sun and under clouds") {
  const Motorway motorway;
  // A screen of 1080 lines over 40 degrees, and one that a processor draws.
  for (const Screen& screen : {Screen{1280, 1080, 0.814, 0.698, 10}, Screen{640, 420, 0.77, 0.52, 3}}) {
    render::Renderer renderer =
        *render::Renderer::create({screen.width_px, screen.height_px, render::DevicePreference::software, false,
                                   render::Antialiasing::automatic, nullptr});
    REQUIRE(renderer.upload(motorway.scene()).has_value());
    for (const double cover : {0.0, 1.0})
      for (const glm::vec3& paint : {glm::vec3(0.8f), glm::vec3(0.45f, 0.01f, 0.01f), glm::vec3(0.02f)}) {
        instant::FrameInput input = car_ahead(motorway, screen, 100.0);
        input.environment.cloud_cover = cover;
        input.participants[0].paint = paint;
        std::array<image::Image, 2> seen;
        for (const bool brakes : {false, true}) {
          input.participants[0].lamps.set(Lamp::low_beam, true);
          input.participants[0].lamps.set(Lamp::brake, brakes);
          REQUIRE(renderer.draw(input).has_value());
          seen[brakes] = *renderer.read_back();
        }
        // The least visible difference is about 2.3; this one is obvious.
        constexpr double plain = 20.0;
        int told_px = 0;
        for (std::uint32_t y = 0; y < screen.height_px; ++y)
          for (std::uint32_t x = 0; x < screen.width_px; ++x) {
            if (seen[0].at(x, y) == seen[1].at(x, y)) continue;
            const glm::dvec3 apart = lab(seen[1].at(x, y)) - lab(seen[0].at(x, y));
            told_px += glm::length(apart) > plain;
          }
        CAPTURE(screen.width_px);
        CAPTURE(cover);
        CAPTURE(paint.r);
        CAPTURE(told_px);
        CHECK(told_px >= screen.least_px);
      }
  }
}

}  // namespace septet

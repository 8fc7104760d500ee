/// Contact of a vehicle with its road without sun shadows. Software device, validation layer on.

#include <cstdint>
#include <string>

#include <doctest/doctest.h>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/instant/reference_scene.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t contact_width = 320, contact_height = 200;

float luminance(const glm::vec3& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

/// Light beside and below a car that stands 10 m ahead, as a share of that of the empty road: means over 12 × 3 pixels.
struct Ground {
  float below = 0.0f;   ///< Between the rear wheels.
  float beside = 0.0f;  ///< 0.8 m to the right of the car.
  image::Image picture;
};

Ground ground(Renderer& renderer, const ReferenceScene& reference, const Environment& environment) {
  FrameInput input;
  input.environment = environment;
  input.views = {forward_view({0, -1.875, 0}, contact_width, contact_height)};
  const auto light = [&] {
    REQUIRE(renderer.draw(input).has_value());
    CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
    return *renderer.read_radiance();
  };
  const RadianceImage empty = light();
  input.participants = {reference_car(reference, {10, -1.875, 0.02})};
  const RadianceImage occupied = light();
  const Vec3 eye_m = world_eye(input.views.front());
  const auto share = [&](const Vec3& place_m) {
    const OffAxisView& projection = input.views.front().projection;
    const Vec3 way = place_m - eye_m;
    const double ahead = -glm::dot(way, projection.back);
    const double x = (glm::dot(way, projection.right) / ahead - projection.left_slope) /
                     (projection.right_slope - projection.left_slope),
                 y = (projection.top_slope - glm::dot(way, projection.up) / ahead) /
                     (projection.top_slope - projection.bottom_slope);
    const auto column = static_cast<std::uint32_t>(x * contact_width),
               row = static_cast<std::uint32_t>(y * contact_height);
    float with = 0.0f, without = 0.0f;
    for (std::uint32_t dy = 0; dy < 3; ++dy)
      for (std::uint32_t dx = 0; dx < 12; ++dx) {
        with += luminance(occupied.at(column + dx - 6, row + dy - 1));
        without += luminance(empty.at(column + dx - 6, row + dy - 1));
      }
    return with / without;
  };
  // The car reaches 1 m behind its origin.
  return {share({9.4, -1.875, 0.0}), share({10.5, -3.5, 0.0}), *renderer.read_back()};
}

}  // namespace

TEST_CASE(
    "below a car the road is dark under a closed cover and beside it less so and in the sun no darker than its "
    "shadow") {
  Renderer renderer =
      *Renderer::create({contact_width, contact_height, DevicePreference::software, true, Antialiasing::none, nullptr});
  const ReferenceScene reference = reference_scene({{}, false, 0});
  REQUIRE(renderer.upload(reference.scene).has_value());
  Environment overcast = reference_day();
  overcast.cloud_cover = 1.0;
  const Ground closed = ground(renderer, reference, overcast);
  image::write_png(build_folder() + "/images/contact.png", closed.picture);
  CAPTURE(closed.below);
  CAPTURE(closed.beside);
  CHECK(closed.below < 0.5f);
  CHECK(closed.beside > 0.7f);
  CHECK(closed.beside < 0.97f);
  // Beside it the sun's light arrives as before.
  const Ground sunny = ground(renderer, reference, reference_day());
  CAPTURE(sunny.beside);
  CHECK(sunny.beside > 0.93f);
}

}  // namespace septet::render

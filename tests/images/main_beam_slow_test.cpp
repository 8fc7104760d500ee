/// Additional visibility of the motorway at night under the main beam.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "tests/checkout.hpp"
#include "tests/images/motorway_view.hpp"

namespace septet {

TEST_CASE(
    "by night a dark van a hundred metres ahead is lit by the main beam many times as much as by the dipped one") {
  const Motorway motorway;
  constexpr std::uint32_t wide = 2 * motorway_width_px, high = 2 * motorway_height_px;
  render::Renderer renderer = *render::Renderer::create(
      {wide, high, render::DevicePreference::software, true, render::Antialiasing::none, nullptr});
  REQUIRE(renderer.upload(motorway.scene()).has_value());
  instant::FrameInput input = motorway.frame({"main beam", 800.0, 0.0, true, false});
  input.views[0].viewport = {0, 0, wide, high};
  Participant van{.id = 7, .model = *find_vehicle_model("van"), .paint = 2};
  van.world_from_vehicle = motorway.frame({"its place", 900.0, 0.0, true, false}).views[0].world_from_car;
  const auto prototype = std::ranges::find(motorway.scene().prototypes, "van", &scene::Prototype::name);
  REQUIRE(prototype != motorway.scene().prototypes.end());
  const instant::DrawnParticipant drawn =
      instant::drawn_participant(van, static_cast<std::uint32_t>(prototype - motorway.scene().prototypes.begin()));
  instant::DrawnParticipant own = input.participants.back();
  const auto light = [&](bool with_van, bool main_beam) {
    own.lamps.set(Lamp::high_beam, main_beam);
    input.participants = {own};
    if (with_van) input.participants.push_back(drawn);
    REQUIRE(renderer.draw(input).has_value());
    CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
    if (with_van)
      image::write_png(build_folder() + (main_beam ? "/images/main_beam.png" : "/images/dipped_beam.png"),
                       *renderer.read_back());
    return *renderer.read_radiance();
  };
  const render::RadianceImage empty = light(false, false), dipped = light(true, false), main = light(true, true);
  // Occluded road: the van's.
  double by_dipped = 0.0, by_main = 0.0;
  int pixels = 0;
  for (std::size_t i = 0; i < empty.radiance.size(); ++i) {
    if (glm::length(dipped.radiance[i] - empty.radiance[i]) < 1e-4f) continue;
    ++pixels;
    by_dipped += double(dipped.radiance[i].g), by_main += double(main.radiance[i].g);
  }
  CAPTURE(pixels);
  CAPTURE(by_dipped);
  CAPTURE(by_main);
  CHECK(pixels > 100);
  CHECK(by_main > 5.0 * by_dipped);
}

}  // namespace septet

/// Times of a frame's passes by the device's clock, if frames are timed. Software device, validation layer on.

#include <algorithm>
#include <string_view>

#include <doctest/doctest.h>

#include "engine/render/renderer.hpp"
#include "tests/engine/instant/reference_scene.hpp"

namespace septet::render {
namespace {

RenderStatistics after_frames(bool timed, std::uint32_t side_px, int frames) {
  auto renderer =
      Renderer::create({side_px, side_px, DevicePreference::software, true, Antialiasing::automatic, nullptr, timed});
  REQUIRE(renderer.has_value());
  const ReferenceScene reference = reference_scene({{}, false, 0});
  REQUIRE(renderer->upload(reference.scene).has_value());
  FrameInput input;
  input.environment = reference_day();
  input.views = {forward_view({}, side_px, side_px)};
  for (int i = 0; i < frames; ++i) REQUIRE(renderer->draw(input).has_value());
  RenderStatistics statistics = renderer->statistics();
  CHECK_MESSAGE(statistics.validation_messages == 0, statistics.first_validation_message);
  return statistics;
}

}  // namespace

TEST_CASE("frames that are timed tell each pass once, and together they took some time") {
  const RenderStatistics statistics = after_frames(true, 64, 4);
  for (const std::string_view pass : {"shadows", "opaque", "sky", "tone mapping", "smoothing"})
    CHECK(std::ranges::count(statistics.pass_times, pass, &PassTime::name) == 1);
  double sum_ms = 0.0;
  for (const PassTime& pass : statistics.pass_times) {
    CHECK(pass.time_ms >= 0.0);
    sum_ms += pass.time_ms;
  }
  CHECK(sum_ms > 0.0);
}

TEST_CASE("the first frames have no times yet, and frames that are not timed never") {
  CHECK(after_frames(true, 64, 2).pass_times.empty());
  CHECK(after_frames(false, 64, 4).pass_times.empty());
}

}  // namespace septet::render

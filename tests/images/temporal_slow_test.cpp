/// Earlier frames lend a picture standing surfaces alone, and no cue that a driver acts on: passes/temporal_pass.hpp,
/// on the software device.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/image/png.hpp"
#include "engine/light/tone_curve.hpp"
#include "engine/render/renderer.hpp"
#include "tests/images/motorway_view.hpp"

namespace septet {
namespace {

constexpr std::uint32_t screen_width_px = 320, screen_height_px = 210;
constexpr double frame_s = 1.0 / 60.0;

class AntialiasedScreen {
 public:
  AntialiasedScreen(const Motorway& motorway, render::Antialiasing antialiasing, std::uint32_t times = 1)
      : renderer_(*render::Renderer::create({.width = screen_width_px * times,
                                             .height = screen_height_px * times,
                                             .device = render::DevicePreference::software,
                                             .validation = true,
                                             .antialiasing = antialiasing,
                                             .bloom = render::Bloom::none})),
        times_(times) {
    REQUIRE(renderer_.upload(motorway.scene()).has_value());
  }

  void draw(instant::FrameInput input) {
    for (instant::FrameView& view : input.views)
      view.viewport = {0, 0, screen_width_px * times_, screen_height_px * times_};
    REQUIRE(renderer_.draw(input).has_value());
    CHECK_MESSAGE(renderer_.statistics().validation_messages == 0, renderer_.statistics().first_validation_message);
  }
  /// The last frame as a display shows it, before its edges are smoothed; the mean of each square of pixels.
  std::vector<glm::vec3> codes() {
    const render::RadianceImage light = *renderer_.read_radiance();
    const float exposure = renderer_.exposure().scale();
    std::vector<glm::vec3> codes(std::size_t{screen_width_px} * screen_height_px, glm::vec3(0.0f));
    for (std::uint32_t y = 0; y < screen_height_px * times_; ++y)
      for (std::uint32_t x = 0; x < screen_width_px * times_; ++x)
        codes[std::size_t{y / times_} * screen_width_px + x / times_] +=
            255.0f * light::display_code(light.at(x, y) * exposure) / static_cast<float>(times_ * times_);
    return codes;
  }
  image::Image picture(const std::string& name) {
    const image::Image shown = *renderer_.read_back();
    if (const char* folder = std::getenv("SEPTET_PICTURES"))
      CHECK(image::write_png(std::string(folder) + "/temporal-" + name + ".png", shown).has_value());
    return shown;
  }

 private:
  render::Renderer renderer_;
  std::uint32_t times_;
};

std::vector<glm::vec3> codes_of(const image::Image& picture) {
  std::vector<glm::vec3> codes;
  codes.reserve(std::size_t{screen_width_px} * screen_height_px);
  for (std::uint32_t y = 0; y < screen_height_px; ++y)
    for (std::uint32_t x = 0; x < screen_width_px; ++x) {
      const image::Color color = picture.at(x, y);
      codes.emplace_back(color.red, color.green, color.blue);
    }
  return codes;
}

float apart(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 off = glm::abs(a - b);
  return std::max({off.x, off.y, off.z});
}

constexpr MotorwayInstant noon{"noon", 800.0, 0.0, false, false}, night{"night", 2400.0, 0.0, true, true};

/// The motorway without others, the eye after so many frames at this speed.
instant::FrameInput alone(const Motorway& motorway, const MotorwayInstant& from, int frame, double speed_mps) {
  MotorwayInstant instant = from;
  instant.s_m += speed_mps * frame_s * frame;
  instant::FrameInput input = motorway.frame(instant);
  input.participants.erase(input.participants.begin(), input.participants.end() - 1);
  input.simulated_time_s += frame_s * frame;
  return input;
}

/// Mean error, in codes, of pixels with visible edges: those with a wrong sample in their middle.
float error_at_edges(const std::vector<glm::vec3>& codes, const std::vector<glm::vec3>& one_sample,
                     const std::vector<glm::vec3>& many_samples) {
  float sum = 0.0f, count = 0.0f;
  for (std::size_t n = 0; n < codes.size(); ++n)
    if (apart(one_sample[n], many_samples[n]) > 10.0f) sum += apart(codes[n], many_samples[n]), ++count;
  CHECK(count > 300.0f);
  return sum / count;
}

/// Of the frames before, standing or driving.
struct Errors {
  float one_sample, smoothed, temporal;
};
Errors errors_after(int frames, double speed_mps) {
  const Motorway motorway;
  AntialiasedScreen temporal(motorway, render::Antialiasing::temporal);
  for (int frame = 0; frame <= frames; ++frame) temporal.draw(alone(motorway, noon, frame, speed_mps));
  const instant::FrameInput last = alone(motorway, noon, frames, speed_mps);
  AntialiasedScreen one(motorway, render::Antialiasing::none), smoothed(motorway, render::Antialiasing::smoothing),
      many(motorway, render::Antialiasing::none, 6);
  one.draw(last), smoothed.draw(last), many.draw(last);
  const std::string name = speed_mps > 0.0 ? "driving" : "standing";
  const std::vector<glm::vec3> one_sample = one.codes(), many_samples = many.codes();
  one.picture(name + " one sample");
  return {error_at_edges(one_sample, one_sample, many_samples),
          error_at_edges(codes_of(smoothed.picture(name + " smoothed")), one_sample, many_samples),
          error_at_edges(codes_of(temporal.picture(name)), one_sample, many_samples)};
}

/// Whether a pixel has another colour than a fresh frame has within two pixels of it.
bool is_stranger(const std::vector<glm::vec3>& codes, const std::vector<glm::vec3>& fresh, std::size_t pixel) {
  constexpr int width = screen_width_px, height = screen_height_px;
  const int x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
  glm::vec3 least(1e9f), most(-1e9f);
  for (int row = std::max(0, y - 2); row <= std::min(height - 1, y + 2); ++row)
    for (int column = std::max(0, x - 2); column <= std::min(width - 1, x + 2); ++column) {
      const glm::vec3& beside = fresh[static_cast<std::size_t>(row * width + column)];
      least = glm::min(least, beside);
      most = glm::max(most, beside);
    }
  const glm::vec3 off = glm::max(least - codes[pixel], codes[pixel] - most);
  return std::max({off.x, off.y, off.z}) > 6.0f;
}

/// A car crosses before the standing eye, 15 m ahead, at 30 m/s.
instant::FrameInput crossing(const Motorway& motorway, int frame, bool sunny) {
  instant::FrameInput input = motorway.frame(noon);
  input.participants.erase(input.participants.begin() + 1, input.participants.end() - 1);
  // A long shadow, on the road and up the wall beside it, far beyond the marks under the car.
  input.environment.sun_elevation_rad = 0.3, input.environment.sun_azimuth_rad = 2.0;
  if (!sunny) input.environment.sun_illuminance_lux = 0.0, input.environment.cloud_cover = 1.0;
  RigidTransform& car = input.participants[0].world_from_vehicle;
  const RigidTransform& own = input.views[0].world_from_car;
  car.position_m = own * Vec3(15.0, 6.0 - 30.0 * frame_s * frame, 0.0);
  input.simulated_time_s += frame_s * frame;
  return input;
}

}  // namespace

TEST_CASE(
    "edges of what stands still are told by the frames before, better than by smoothing, standing and at 30 m/s") {
  const Errors standing = errors_after(32, 0.0), driving = errors_after(32, 30.0);
  CAPTURE(standing.one_sample);
  CAPTURE(standing.smoothed);
  CAPTURE(standing.temporal);
  CAPTURE(driving.one_sample);
  CAPTURE(driving.smoothed);
  CAPTURE(driving.temporal);
  CHECK(standing.temporal < 0.75f * standing.smoothed);
  CHECK(driving.temporal < 0.85f * driving.smoothed);
}

TEST_CASE("a car that crosses and its shadow leave no trail, and the car is as in a frame that stands alone") {
  const Motorway motorway;
  AntialiasedScreen fresh(motorway, render::Antialiasing::none);
  const auto fresh_codes = [&](const instant::FrameInput& input) {
    fresh.draw(input);
    return fresh.codes();
  };
  for (const bool sunny : {true, false}) {
    CAPTURE(sunny);
    AntialiasedScreen temporal(motorway, render::Antialiasing::temporal);
    for (int frame = 0; frame < 18; ++frame) {
      CAPTURE(frame);
      const instant::FrameInput input = crossing(motorway, frame, sunny);
      temporal.draw(input);
      if (frame % 6 != 5) continue;
      const std::vector<glm::vec3> shown = temporal.codes(), now = fresh_codes(input);
      temporal.picture("crossing " + std::to_string(frame) + (sunny ? " sunny" : " overcast"));
      const std::vector<glm::vec3> before = fresh_codes(crossing(motorway, frame - 1, sunny));
      int left = 0, trail = 0;
      for (std::size_t n = 0; n < shown.size(); ++n)
        if (apart(before[n], now[n]) > 20.0f) ++left, trail += is_stranger(shown, now, n);
      CAPTURE(left);
      CHECK(left > 200);
      CHECK(trail <= left / 50);
      if (sunny) continue;
      // Without a sun its shadow is a mark of the frame, too: the difference is the car.
      instant::FrameInput gone = input;
      gone.participants.erase(gone.participants.begin());
      const std::vector<glm::vec3> without = fresh_codes(gone);
      int car = 0, other = 0;
      for (std::size_t n = 0; n < shown.size(); ++n)
        if (apart(now[n], without[n]) > 25.0f) ++car, other += apart(shown[n], now[n]) > 2.0f;
      CAPTURE(car);
      CHECK(car > 500);
      CHECK(other <= car / 50);
    }
  }
}

TEST_CASE("a brake lamp that is switched on or off is so in the very next picture") {
  const Motorway motorway;
  for (const MotorwayInstant& instant : {noon, night}) {
    CAPTURE(instant.name);
    AntialiasedScreen temporal(motorway, render::Antialiasing::temporal), fresh(motorway, render::Antialiasing::none),
        ever_lit(motorway, render::Antialiasing::temporal), never_lit(motorway, render::Antialiasing::temporal);
    instant::FrameInput dark = motorway.frame(instant), braking = dark;
    dark.participants[0].lamps.set(Lamp::brake, false);
    braking.participants[0].lamps.set(Lamp::brake, true);
    fresh.draw(dark);
    const std::vector<glm::vec3> unlit = fresh.codes();
    fresh.draw(braking);
    const std::vector<glm::vec3> lit = fresh.codes();
    for (int frame = 0; frame < 12; ++frame) temporal.draw(dark);
    temporal.draw(braking);
    const std::vector<glm::vec3> on = temporal.codes();
    temporal.picture(std::string(instant.name) + " braking");
    temporal.draw(dark);
    const std::vector<glm::vec3> off = temporal.codes();
    for (int frame = 0; frame < 13; ++frame) ever_lit.draw(braking);
    for (int frame = 0; frame < 14; ++frame) never_lit.draw(dark);
    const std::vector<glm::vec3> always = ever_lit.codes(), never = never_lit.codes();
    int lamp = 0, late = 0, lasting = 0;
    for (std::size_t n = 0; n < lit.size(); ++n) {
      if (apart(lit[n], unlit[n]) < 25.0f) continue;
      ++lamp;
      late += apart(on[n], always[n]) > 3.0f;
      lasting += apart(off[n], never[n]) > 3.0f;
    }
    CAPTURE(lamp);
    CHECK(lamp > 30);
    CHECK(late <= lamp / 10);  // Its reflection in the road's ripples comes up to some frames later.
    CHECK(lasting <= lamp / 10);
  }
}

TEST_CASE("a picture of what stands does not tremble, by day, by night, on a wet road") {
  const Motorway motorway;
  for (const MotorwayInstant& instant : {noon, MotorwayInstant{"dry night", 2400.0, 0.0, true, false}, night}) {
    CAPTURE(instant.name);
    AntialiasedScreen temporal(motorway, render::Antialiasing::temporal);
    instant::FrameInput input = motorway.frame(instant);
    input.environment.rain_mm_per_h = 0.0;  // It is wet, but no drop falls.
    input.views[0].world_from_car.position_m.z += 0.3;
    std::vector<glm::vec3> before;
    int trembling = 0;
    for (int frame = 0; frame < 28; ++frame) {
      temporal.draw(input);
      const std::vector<glm::vec3> codes = codes_of(temporal.picture(std::string(instant.name) + " standing"));
      if (frame > 20)
        for (std::size_t n = 0; n < codes.size(); ++n) trembling += apart(codes[n], before[n]) > 12.0f;
      before = codes;
    }
    CHECK(trembling / 7 < 150);  // Of 67,200: far things that are smaller than a pixel.
  }
}

TEST_CASE("after a leap of time or place a picture is that of a renderer that has drawn nothing") {
  const Motorway motorway;
  const auto drawn_after = [&](const std::vector<instant::FrameInput>& inputs) {
    AntialiasedScreen screen(motorway, render::Antialiasing::temporal);
    for (const instant::FrameInput& input : inputs) screen.draw(input);
    return screen.picture("leap").rgba;
  };
  const instant::FrameInput before = alone(motorway, noon, 0, 0.0), beside = alone(motorway, noon, 3, 30.0);
  instant::FrameInput later = beside, earlier = beside, elsewhere = alone(motorway, noon, 120, 30.0);
  later.simulated_time_s += 1.0;
  earlier.simulated_time_s -= 1.0;
  elsewhere.simulated_time_s = before.simulated_time_s + frame_s;
  for (const instant::FrameInput& leap : {later, earlier, elsewhere})
    CHECK(drawn_after({before, leap}) == drawn_after({leap}));
  CHECK(drawn_after({before, beside}) != drawn_after({beside}));
}

}  // namespace septet

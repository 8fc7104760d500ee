#include "engine/render/passes/inset_housing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

#include "engine/light/language.hpp"
#include "engine/light/tone_curve.hpp"

namespace septet::render {
namespace {

using light::QuadConstants;

/// Shares of the picture's lesser side: radius of its corners, and width of the frame, which covers the picture beyond
/// the rounded corners (at least √2 − 1 of the radius).
constexpr float corner_share = 0.17f, frame_share = 0.085f;

/// Dull black in the light that falls into a cabin, as the display shows it.
glm::vec3 housing_code(const instant::Instant& instant) {
  constexpr float albedo = 0.05f, into_cabin = 0.5f;
  const glm::vec3 irradiance = into_cabin * instant.share_of_sky * instant.light->sky_irradiance;
  return light::display_code(irradiance * (albedo / light::pi * instant.exposure.scale()));
}

/// Converts pixels to the records of quads.
class HousingDrawing {
 public:
  HousingDrawing(std::uint32_t width, std::uint32_t height, const glm::vec3& code)
      : per_px_(2.0f / static_cast<float>(width), 2.0f / static_cast<float>(height)), code_(code, 1.0f) {}

  void bar(const glm::vec2& from_px, const glm::vec2& to_px) {
    quads_.push_back({ndc(from_px, to_px), glm::vec4(0.0f), code_, glm::vec4(0.0f)});
  }
  void frame(const glm::vec2& from_px, const glm::vec2& to_px, float width_px, float radius_px) {
    const glm::vec2 half = 0.5f * (to_px - from_px);
    quads_.push_back({ndc(from_px, to_px), glm::vec4(-half, half), code_, {2.0f, width_px, radius_px, 0.0f}});
  }
  std::vector<QuadConstants> take() { return std::move(quads_); }

 private:
  glm::vec4 ndc(const glm::vec2& from_px, const glm::vec2& to_px) const {
    return glm::vec4(from_px * per_px_ - 1.0f, to_px * per_px_ - 1.0f);
  }

  glm::vec2 per_px_;
  glm::vec4 code_;
  std::vector<QuadConstants> quads_;
};

}  // namespace

std::vector<QuadConstants> inset_housings(const instant::Instant& instant, std::uint32_t width, std::uint32_t height) {
  HousingDrawing drawing(width, height, housing_code(instant));
  const glm::vec2 size(width, height);
  for (const instant::FrameView& view : instant.views) {
    if (!view.housed) continue;
    const glm::vec2 low(view.viewport.x, view.viewport.y),
        high = low + glm::vec2(view.viewport.width, view.viewport.height);
    const float lesser = std::min(high.x - low.x, high.y - low.y), frame = std::round(frame_share * lesser);
    if (frame < 1.0f) continue;
    const glm::vec2 outer_low = low - frame, outer_high = high + frame;
    // Foot from the straight part of the frame's side to an edge of the screen no further away than the mirror is high.
    const glm::vec2 middle = 0.5f * (low + high), foot = 0.16f * (high - low);
    if (outer_low.y > 0.0f && low.y < lesser && middle.y < 0.5f * size.y)
      drawing.bar({middle.x - 0.5f * foot.x, 0.0f}, {middle.x + 0.5f * foot.x, low.y - 0.5f * frame});
    else if (outer_low.x > 0.0f && low.x < lesser)
      drawing.bar({0.0f, high.y - 2.0f * foot.y - frame}, {low.x - 0.5f * frame, high.y - foot.y - frame});
    else if (outer_high.x < size.x && size.x - high.x < lesser)
      drawing.bar({high.x + 0.5f * frame, high.y - 2.0f * foot.y - frame}, {size.x, high.y - foot.y - frame});
    drawing.frame(outer_low, outer_high, frame, corner_share * lesser + frame);
  }
  return drawing.take();
}

}  // namespace septet::render

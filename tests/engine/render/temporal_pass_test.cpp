#include "engine/render/passes/temporal_pass.hpp"

#include <cmath>
#include <cstdint>

#include <doctest/doctest.h>

#include "engine/instant/view.hpp"
#include "engine/render/passes/view_uniforms.hpp"

namespace septet::render {

TEST_CASE("eight frames sample a pixel evenly, within half a pixel of its middle") {
  glm::vec2 mean(0.0f);
  std::uint32_t columns = 0, rows = 0;
  for (std::uint32_t frame = 0; frame < 8; ++frame) {
    const glm::vec2 offset_px = sample_offset_px(frame);
    CHECK(std::abs(offset_px.x) <= 0.5f);
    CHECK(std::abs(offset_px.y) <= 0.5f);
    CHECK(offset_px == sample_offset_px(frame + 8));
    mean += offset_px * 0.125f;
    columns |= 1u << static_cast<std::uint32_t>((offset_px.x + 0.5f) * 8.0f);
    rows |= 1u << static_cast<std::uint32_t>((offset_px.y + 0.5f) * 3.0f);
  }
  CHECK(columns == 0xffu);
  CHECK(rows == 0x7u);
  CHECK(std::abs(mean.x) < 0.1f);
  CHECK(std::abs(mean.y) < 0.1f);
}

TEST_CASE("a frame leads to one that sees the same world a moment later from beside, and to no other") {
  Instant instant;
  instant.simulated_time_s = 100.0;
  FrameView view;
  view.projection = instant::symmetric_view(Vec3(0.0, 0.0, 1.2), 0.0, 0.0, 0.8, 0.5);
  view.viewport = {0, 0, 64, 40};
  instant.views = {view};
  const SeenFrame before = seen_frame(instant, 7);
  CHECK(leads_to(before, before));
  SeenFrame now = before;
  now.simulated_time_s += 0.1, now.views[0].eye_m.x += 5.0;
  CHECK(leads_to(before, now));
  CHECK_FALSE(leads_to(now, before));
  now.simulated_time_s = 101.0;
  CHECK_FALSE(leads_to(before, now));
  now.simulated_time_s = std::nan("");
  CHECK_FALSE(leads_to(before, now));
  now = before, now.scene_revision = 8;
  CHECK_FALSE(leads_to(before, now));
  now = before, now.views[0].eye_m.y += 100.0;
  CHECK_FALSE(leads_to(before, now));
  now = before, now.views[0].viewport.width = 32;
  CHECK_FALSE(leads_to(before, now));
  now = before, now.views.push_back(now.views[0]);
  CHECK_FALSE(leads_to(before, now));
}

}  // namespace septet::render

#include "sim-client/ice/ice_window.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <string>

#include "engine/render/renderer.hpp"
#include "engine/render/window.hpp"
#include "program/clock.hpp"
#include "program/stop_signal.hpp"
#include "sim-client/ice/ice_switches.hpp"

namespace septet::ice_viewer {
namespace {

void add_text(instant::FrameInput& input, const IceOptions& options) {
  constexpr float line_px = 16.0f;
  float y_px = 6.0f;
  for (const std::string& line : switches(options)) {
    input.overlay.push_back({line, 8.0f, y_px, line_px, {1.0f, 1.0f, 1.0f, 1.0f}, {0.0f, 0.0f, 0.0f, 0.55f}});
    y_px += 1.25f * line_px;
  }
}

}  // namespace

Expected<int> show_in_window(const ice::Surface& surface, IceOptions options) {
  auto window = render::Window::open({"Ice", options.width_px, options.height_px, {}, false});
  if (!window)
    return failure(window.error().what, "--window", "start it in a graphical session, or leave --window out");
  const auto fit = [&] {
    options.width_px = std::max(1u, window->width());
    options.height_px = std::max(1u, window->height());
  };
  fit();
  auto renderer =
      render::Renderer::create({options.width_px, options.height_px,
                                options.software ? render::DevicePreference::software : render::DevicePreference::any,
                                false, render::Antialiasing::automatic, &*window});
  if (!renderer) return tl::unexpected(renderer.error());
  if (const auto uploaded = renderer->upload(scene_around(options.surroundings)); !uploaded)
    return tl::unexpected(uploaded.error());
  std::array<bool, key_count> held{};
  bool turning = true, explained = true;
  double turn_rad = options.turn_deg * std::numbers::pi / 180.0, before_s = program::monotonic_s();
  while (!window->should_close() && !program::should_stop()) {
    window->poll();
    const double now_s = program::monotonic_s(), step_s = std::min(now_s - before_s, 0.2);
    before_s = now_s;
    for (std::size_t i = 0; i < key_count; ++i) {
      const Key key = static_cast<Key>(i);
      const bool down = window->is_down(key), pressed = down && !held[i];
      held[i] = down;
      if (!pressed) continue;
      if (key == Key::escape) return 0;
      if (key == Key::space) turning = !turning;
      if (key == Key::f1) explained = !explained;
      press(options, key);
    }
    const auto is_held = [&](Key key) { return held[static_cast<std::size_t>(key)] ? 1.0 : 0.0; };
    turn_rad += step_s * ((turning ? 0.3 : 0.0) + 1.2 * (is_held(Key::arrow_right) - is_held(Key::arrow_left)));
    options.share_of_picture = std::clamp(
        options.share_of_picture * (1.0 + 1.5 * step_s * (is_held(Key::arrow_up) - is_held(Key::arrow_down))), 0.01,
        4.0);
    fit();
    if (const auto resized = renderer->resize(options.width_px, options.height_px); !resized)
      return tl::unexpected(resized.error());
    instant::FrameInput input = frame_of(surface, options, turn_rad);
    if (explained) add_text(input, options);
    if (const auto drawn = renderer->draw(std::move(input)); !drawn) return tl::unexpected(drawn.error());
  }
  return 0;
}

}  // namespace septet::ice_viewer

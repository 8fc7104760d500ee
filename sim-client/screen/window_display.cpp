#include "car-io/keyboard_driver.hpp"
#include "engine/render/window.hpp"
#include "sim-client/screen/screen_display.hpp"

namespace septet::screen {
namespace {

using render::Key;

car_io::KeyStates keys_of(const render::Window& window) {
  const auto down = [&](Key key) { return window.is_down(key); };
  car_io::KeyStates keys;
  keys.left = down(Key::left) || down(Key::a);
  keys.right = down(Key::right) || down(Key::d);
  keys.accelerate = down(Key::up) || down(Key::w);
  keys.brake = down(Key::down) || down(Key::s);
  keys.parking_brake = down(Key::space);
  keys.indicator_left = down(Key::comma);
  keys.indicator_right = down(Key::period);
  keys.hazard_lights = down(Key::x);
  keys.low_beam = down(Key::l);
  keys.high_beam = down(Key::f);
  keys.horn = down(Key::h);
  keys.look_left = down(Key::q);
  keys.look_right = down(Key::e);
  return keys;
}

car_io::GamepadState gamepad_of(const render::Gamepad& pad) {
  car_io::GamepadState state;
  state.left_stick_x = pad.left_x;
  state.right_stick_x = pad.right_x;
  state.left_trigger = 2.0 * pad.left_trigger - 1.0;
  state.right_trigger = 2.0 * pad.right_trigger - 1.0;
  state.buttons.indicator_left = pad.left_bumper;
  state.buttons.indicator_right = pad.right_bumper;
  state.buttons.parking_brake = pad.b;
  state.buttons.horn = pad.a;
  state.reverse = pad.y;
  return state;
}

class WindowDisplay final : public Display {
 public:
  WindowDisplay(std::unique_ptr<render::Window> window, render::Renderer renderer)
      : window_(std::move(window)), renderer_(std::move(renderer)) {}

  render::Renderer& renderer() override { return renderer_; }
  bool poll_closed() override {
    window_->poll();
    return window_->should_close() || window_->is_down(Key::escape);
  }
  std::optional<DriverInput> controls(double now_s, double speed_mps) override {
    const double dt_s = last_s_ ? now_s - *last_s_ : 0.0;
    last_s_ = now_s;
    if (const auto pad = window_->gamepad()) return car_io::advance(gamepad_, gamepad_of(*pad), speed_mps, dt_s);
    return car_io::advance(keyboard_, keys_of(*window_), speed_mps, dt_s);
  }
  bool paces_itself() const override { return true; }

 private:
  std::unique_ptr<render::Window> window_;  // Outlives the renderer that presents into it.
  render::Renderer renderer_;
  car_io::KeyboardDriver keyboard_;
  car_io::GamepadDriver gamepad_;
  std::optional<double> last_s_;
};

}  // namespace

Expected<std::unique_ptr<Display>> open_window(const DisplayOptions& options, render::RendererOptions renderer_options) {
  render::WindowOptions window_options;
  window_options.title = options.title;
  window_options.width = options.width_px;
  window_options.height = options.height_px;
  if (options.full_screen) window_options.full_screen_on = static_cast<std::uint32_t>(options.monitor);
  auto opened = render::Window::open(window_options);
  if (!opened) return tl::unexpected(opened.error());
  auto window = std::make_unique<render::Window>(std::move(*opened));
  renderer_options.window = window.get();
  auto renderer = render::Renderer::create(renderer_options);
  if (!renderer) return tl::unexpected(renderer.error());
  return std::make_unique<WindowDisplay>(std::move(window), std::move(*renderer));
}

}  // namespace septet::screen

#include <cmath>
#include <utility>

#include "car-io/driving_keys.hpp"
#include "engine/render/window.hpp"
#include "sim-client/screen/screen_display.hpp"

namespace septet::screen {
namespace {

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

/// True if a hand is on the gamepad.
bool is_held(const render::Gamepad& pad) {
  constexpr float clearly = 0.3f;
  return std::abs(pad.left_x) > clearly || std::abs(pad.right_x) > clearly || pad.left_trigger > clearly ||
         pad.right_trigger > clearly || pad.a || pad.b || pad.x || pad.y || pad.left_bumper || pad.right_bumper;
}

class WindowDisplay final : public Display {
 public:
  WindowDisplay(std::unique_ptr<render::Window> window, render::Renderer renderer)
      : window_(std::move(window)), renderer_(std::move(renderer)) {}

  render::Renderer& renderer() override { return renderer_; }
  std::optional<Size> window_size() const override {
    const Size size{window_->width(), window_->height()};
    return size.width_px > 0 && size.height_px > 0 ? std::optional(size) : std::nullopt;
  }
  void attend() override {
    window_->poll();
    const bool keys_key = window_->is_down(Key::f1);
    keys_asked_for_ = keys_asked_for_ || (keys_key && !keys_key_was_down_);
    keys_key_was_down_ = keys_key;
    const auto pad = window_->gamepad();
    touched_ = touched_ || window_->was_touched() || (pad && is_held(*pad));
  }
  Leaving poll_leaving() override {
    attend();
    if (window_->should_close()) return Leaving::closed;
    // Both keys are queried: a window forgets a short press only when it is queried.
    const bool escape = window_->is_down(Key::escape), restart = window_->is_down(Key::r),
               enter = window_->is_down(Key::enter);
    const bool is_escape = !std::exchange(escape_was_down_, escape) && escape;
    const bool is_restart = !std::exchange(restart_was_down_, restart) && restart;
    const bool is_enter = !std::exchange(enter_was_down_, enter) && enter;
    if (is_escape) return Leaving::escape;
    if (is_restart) return Leaving::restart;
    return is_enter ? Leaving::enter : Leaving::no;
  }
  std::optional<DriverInput> controls(double now_s, double speed_mps) override {
    const double dt_s = last_s_ ? now_s - *last_s_ : 0.0;
    last_s_ = now_s;
    if (!touched_) return std::nullopt;
    if (const auto pad = window_->gamepad()) return car_io::advance(gamepad_, gamepad_of(*pad), speed_mps, dt_s);
    const auto keys = car_io::key_states([&](Key key) { return window_->is_down(key); });
    if (keys != car_io::KeyStates{}) used_s_ = now_s;
    const DriverInput input = car_io::advance(keyboard_, keys, speed_mps, dt_s);
    // Among a rig's windows, the one with the keyboard drives; the others are silent, once their held keys have been
    // let go.
    return now_s - used_s_ < let_go_after_s ? std::optional(input) : std::nullopt;
  }
  bool is_touched() const override { return touched_; }
  bool take_keys_request() override { return std::exchange(keys_asked_for_, false); }
  bool paces_itself() const override { return true; }

 private:
  std::unique_ptr<render::Window> window_;  // Outlives the renderer that presents into it.
  render::Renderer renderer_;
  car_io::KeyboardDriver keyboard_;
  car_io::GamepadDriver gamepad_;
  static constexpr double let_go_after_s = 2.0;
  std::optional<double> last_s_;
  double used_s_ = -let_go_after_s;
  bool touched_ = false, keys_asked_for_ = false, keys_key_was_down_ = false;
  bool escape_was_down_ = false, restart_was_down_ = false, enter_was_down_ = false;
};

}  // namespace

Expected<std::unique_ptr<Display>> open_window(const DisplayOptions& options,
                                               render::RendererOptions renderer_options) {
  render::WindowOptions window_options;
  window_options.title = options.title;
  window_options.width = options.width_px;
  window_options.height = options.height_px;
  window_options.monitor = options.monitor;
  window_options.full_screen = options.full_screen;
  auto opened = render::Window::open(window_options);
  if (!opened) return tl::unexpected(opened.error());
  auto window = std::make_unique<render::Window>(std::move(*opened));
  renderer_options.window = window.get();
  auto renderer = render::Renderer::create(renderer_options);
  if (!renderer) return tl::unexpected(renderer.error());
  return std::make_unique<WindowDisplay>(std::move(window), std::move(*renderer));
}

}  // namespace septet::screen

#pragma once
/// The car as a Linux wheel (uinput), for any game: axes and buttons out, force effects in.
///
/// Axes by games' convention for wheels: X the hand wheel, Z the accelerator, RZ the brake, Y the clutch. One thread.
/// Errors: this user may not create one (udev rule in packaging), or it was removed.

#include <cstdint>
#include <memory>
#include <vector>

#include "car-io/games/force_effects.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/driver_input.hpp"

struct ff_effect;

namespace septet::car_io {

/// From Linux' form of an effect.
ForceEffect force_effect_of(const ff_effect& effect);

/// Events for a game from the controls: each one's type, code and value.
struct WheelEvent {
  std::uint16_t type = 0, code = 0;
  std::int32_t value = 0;
  bool operator==(const WheelEvent&) const = default;
};
/// Only the changes; `before` may be null: everything.
std::vector<WheelEvent> wheel_events(const DriverInput& now, const DriverInput* before, double steering_lock_rad);

class UinputWheel {
 public:
  static Expected<UinputWheel> create();
  UinputWheel(UinputWheel&&) noexcept;
  UinputWheel& operator=(UinputWheel&&) noexcept;
  ~UinputWheel();

  Expected<void> show(const DriverInput& input, double steering_lock_rad);
  /// Takes the game's loads, starts and stops since the last call. Never waits.
  Expected<void> take_effects(ForceEffects& effects, double now_s);

 private:
  struct State;
  explicit UinputWheel(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace septet::car_io

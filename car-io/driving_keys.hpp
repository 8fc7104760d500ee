#pragma once
/// Assignment of keys: the one table that the window uses and that docs/driving.md, `septet drive --help`, the terminal
/// and the screen show.

#include <array>
#include <functional>
#include <span>
#include <string>

#include "car-io/keyboard_driver.hpp"
#include "engine/world/key.hpp"

namespace septet::car_io {

/// One action of the driver, and its keys.
struct DrivingKey {
  std::array<Key, 2> keys;          ///< Either of them; the same one twice without an alternative.
  bool KeyStates::*held = nullptr;  ///< Its state while it is down; null: the window handles it (Escape, F1).
  const char* does = "";
};

std::span<const DrivingKey> driving_keys();

/// States of a keyboard whose pressed keys satisfy `is_down`.
KeyStates key_states(const std::function<bool(Key)>& is_down);

/// "Arrow up, W".
std::string names_of_keys(const DrivingKey& key);

/// All of them, a line each, and the gamepad's: for terminals.
std::string driving_keys_text();

/// Sticks and buttons of a gamepad, in a sentence.
inline constexpr const char* gamepad_text =
    "A gamepad drives too: left stick steers, triggers accelerate and brake, bumpers indicate, A horn, B parking "
    "brake, Y reverse.";

}  // namespace septet::car_io

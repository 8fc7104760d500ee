#pragma once
/// Which key does what: the one table that the window obeys and that docs/driving.md, `septet drive --help`, the terminal and the
/// screen show.

#include <array>
#include <functional>
#include <span>
#include <string>

#include "car-io/keyboard_driver.hpp"
#include "engine/world/key.hpp"

namespace septet::car_io {

/// One thing that the driver can do, and the keys that do it.
struct DrivingKey {
  std::array<Key, 2> keys;          ///< Either of them; the same one twice where there is no other.
  bool KeyStates::*held = nullptr;  ///< What it means while it is down; null: the window minds it (Escape, F1).
  const char* does = "";
};

std::span<const DrivingKey> driving_keys();

/// What a keyboard says on which `is_down` holds of the keys that are down.
KeyStates key_states(const std::function<bool(Key)>& is_down);

/// "Arrow up, W".
std::string names_of_keys(const DrivingKey& key);

/// All of them, a line each, and the gamepad's: for terminals.
std::string driving_keys_text();

/// What a gamepad's sticks and buttons do, in a sentence.
inline constexpr const char* gamepad_text =
    "A gamepad drives too: left stick steers, triggers accelerate and brake, bumpers indicate, A horn, B parking "
    "brake, Y reverse.";

}  // namespace septet::car_io

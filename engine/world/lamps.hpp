#pragma once
/// Lamps, siren and horn of a vehicle, and lamps of a traffic light, one bit each.

#include <cstdint>

namespace septet {

enum class Lamp : std::uint16_t {
  brake = 1 << 0,
  reverse = 1 << 1,
  indicator_left = 1 << 2,  ///< Lit now: blinking happens in the simulation, so that every screen agrees.
  indicator_right = 1 << 3,
  low_beam = 1 << 4,
  high_beam = 1 << 5,
  rear_fog = 1 << 6,
  beacon = 1 << 7,  ///< Emergency beacon switched on; its flashing is a function of simulated time.
  siren = 1 << 8,
  horn = 1 << 9,
  signal_red = 1 << 10,  ///< Lamps of a traffic light, here and below.
  signal_amber = 1 << 11,
  signal_green = 1 << 12,
  parking_brake = 1 << 13,  ///< The warning lamp among the instruments.
};

/// A set of lamps.
struct Lamps {
  std::uint16_t bits = 0;

  bool has(Lamp lamp) const { return (bits & static_cast<std::uint16_t>(lamp)) != 0; }
  void set(Lamp lamp, bool on) {
    const auto bit = static_cast<std::uint16_t>(lamp);
    bits = static_cast<std::uint16_t>(on ? bits | bit : bits & ~bit);
  }
  bool operator==(const Lamps&) const = default;
};

}  // namespace septet

#include "car-io/games/telemetry.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/core.h>

namespace septet::car_io {
namespace {

using T = GameTelemetry;
using enum NumberKind;

constexpr double largest = 1e6;

std::size_t bytes_of(NumberKind kind) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(kind)];
}

/// InSim.txt of Live for Speed: OutGaugePack, with its lamps DL_….
TelemetryFormat outgauge() {
  constexpr std::size_t gear = 10, speed = 12, rpm = 16, coolant = 24, fuel = 28, lamps = 44;
  const auto lamp = [](double T::*quantity, int bit) {
    return TelemetryField{.quantity = quantity, .byte = lamps, .kind = u32, .bit = bit};
  };
  return {"outgauge",
          92,
          96,
          30000,
          {{.quantity = &T::gear, .byte = gear, .kind = u8, .offset = -1.0},
           {.quantity = &T::speed_mps, .byte = speed},
           {.quantity = &T::engine_rpm, .byte = rpm},
           {.quantity = &T::coolant_temperature_c, .byte = coolant},
           {.quantity = &T::fuel_share, .byte = fuel},
           {.quantity = &T::accelerator, .byte = 48},
           {.quantity = &T::brake, .byte = 52},
           {.quantity = &T::clutch, .byte = 56},
           lamp(&T::high_beam, 1),
           lamp(&T::parking_brake, 2),
           lamp(&T::indicator_left, 5),
           lamp(&T::indicator_right, 6),
           lamp(&T::anti_lock, 10)}};
}

/// OutSimPack of the same document: time, angular velocity, three angles, acceleration, velocity (floats), position
/// (integers).
TelemetryFormat outsim() { return {"outsim", 64, 68, 30001, {{.quantity = &T::vertical_mps2, .byte = 36}}}; }

/// Floats in a row, as DiRT Rally sends them with extradata="3"; engine speeds are tenths, and reverse is gear 10 in
/// some games, −1 in others.
TelemetryFormat codemasters() {
  const auto at = [](std::size_t place) { return 4 * place; };
  return {"codemasters",
          at(38),
          at(70),
          20777,
          {{.quantity = &T::speed_mps, .byte = at(7)},
           {.quantity = &T::accelerator, .byte = at(29)},
           {.quantity = &T::brake, .byte = at(31)},
           {.quantity = &T::clutch, .byte = at(32)},
           {.quantity = &T::gear, .byte = at(33), .reverse = 10.0},
           {.quantity = &T::engine_rpm, .byte = at(37), .scale = 10.0}}};
}

std::uint64_t raw_at(std::span<const std::byte> bytes, const TelemetryField& field) {
  std::uint64_t raw = 0;
  const std::size_t size = bytes_of(field.kind);
  for (std::size_t i = 0; i < size; ++i)
    raw |= static_cast<std::uint64_t>(bytes[field.byte + (field.big_endian ? size - 1 - i : i)]) << (8 * i);
  return raw;
}

double number_at(std::span<const std::byte> bytes, const TelemetryField& field) {
  const std::uint64_t raw = raw_at(bytes, field);
  if (field.bit >= 0) return (raw >> field.bit & 1u) != 0 ? 1.0 : 0.0;
  switch (field.kind) {
    case i8:
      return static_cast<std::int8_t>(raw);
    case i16:
      return static_cast<std::int16_t>(raw);
    case i32:
      return static_cast<std::int32_t>(raw);
    case f32:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
    case f64:
      return std::bit_cast<double>(raw);
    default:
      return static_cast<double>(raw);
  }
}

tl::unexpected<Error> refused(const TelemetryFormat& format, std::string what) {
  return failure(std::move(what), "the game's telemetry",
                 fmt::format("check that the game sends {} to this port", format.name));
}

}  // namespace

const std::vector<TelemetryFormat>& known_telemetry_formats() {
  static const std::vector<TelemetryFormat> formats{outgauge(), outsim(), codemasters()};
  return formats;
}

Expected<const TelemetryFormat*> find_telemetry_format(std::string_view name) {
  for (const TelemetryFormat& format : known_telemetry_formats())
    if (format.name == name) return &format;
  return failure(fmt::format("there is no telemetry format '{}'", name), "--game",
                 "use outgauge, outsim, codemasters, or a TOML file (car-io/games/README.md)");
}

Expected<GameTelemetry> decode_telemetry(const TelemetryFormat& format, std::span<const std::byte> datagram,
                                         const GameTelemetry& before) {
  if (datagram.size() < format.least_bytes || datagram.size() > format.most_bytes)
    return refused(format, fmt::format("a datagram has {} bytes, where {} to {} belong", datagram.size(),
                                       format.least_bytes, format.most_bytes));
  GameTelemetry now = before;
  for (const TelemetryField& field : format.fields) {
    if (field.byte + bytes_of(field.kind) > datagram.size()) continue;
    const double number = number_at(datagram, field);
    const double value = number == field.reverse   ? -1.0
                         : number == field.neutral ? 0.0
                                                   : number * field.scale + field.offset;
    if (!(std::abs(value) <= largest))
      return refused(format, "a datagram has a number that is not finite, or out of bounds");
    now.*field.quantity = value;
  }
  return now;
}

CarMotion motion_of(const GameTelemetry& now, const GameTelemetry& before, double seconds) {
  CarMotion motion;
  motion.speed_mps = now.speed_mps;
  motion.engine_radps = std::max(now.engine_rpm, 0.0) * std::numbers::pi / 30.0;
  motion.engine_load = std::clamp(now.accelerator, 0.0, 1.0);
  motion.cylinders = 4;
  motion.anti_lock_active = now.anti_lock > 0.5 && now.brake > 0.05;
  // Thresholds as for Septet's own roads: vertical acceleration beyond a road's, or a stop beyond brakes.
  constexpr double bump_from_mps2 = 8.0, bump_full_mps2 = 30.0, blow_from_mps2 = 25.0, blow_full_mps2 = 120.0;
  motion.bump =
      std::clamp((std::abs(now.vertical_mps2) - bump_from_mps2) / (bump_full_mps2 - bump_from_mps2), 0.0, 1.0);
  if (seconds > 1e-3 && seconds < 0.5) {
    const double jolt_mps2 = std::abs(now.speed_mps - before.speed_mps) / seconds;
    motion.blow = std::clamp((jolt_mps2 - blow_from_mps2) / (blow_full_mps2 - blow_from_mps2), 0.0, 1.0);
  }
  return motion;
}

Instruments instruments_of(const GameTelemetry& now) {
  Instruments shown;
  shown.ignition = 1.0;
  shown.speed_kmh = std::abs(now.speed_mps) * 3.6;
  shown.engine_rpm = std::max(now.engine_rpm, 0.0);
  shown.gear = now.gear;
  shown.selector = now.gear < -0.5 ? 1.0 : now.gear < 0.5 ? 2.0 : 3.0;
  shown.coolant_temperature_c = now.coolant_temperature_c;
  shown.fuel_percent = 100.0 * now.fuel_share;
  shown.indicator_left = now.indicator_left;
  shown.indicator_right = now.indicator_right;
  shown.high_beam = now.high_beam;
  shown.parking_brake = now.parking_brake;
  shown.anti_lock = now.anti_lock;
  shown.engine_stopped = now.engine_rpm > 1.0 ? 0.0 : 1.0;
  return shown;
}

}  // namespace septet::car_io

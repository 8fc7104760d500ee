#pragma once
/// Telemetry of a commercial game's car, datagram by datagram: Live for Speed's OutGauge and OutSim, the UDP packets of
/// Codemasters' rally and racing games, and any other by a TOML file (README.md).
///
/// Bytes come from any sender that reaches the port: datagrams with non-finite values, values beyond bounds or another
/// length are refused as a whole. Pure functions; they allocate nothing but errors.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "car-io/actuators.hpp"
#include "car-io/can/can_plan.hpp"
#include "engine/core/expected.hpp"

namespace septet::car_io {

/// Union of all games' quantities; a quantity that a game lacks keeps its value.
struct GameTelemetry {
  double speed_mps = 0.0;
  double engine_rpm = 0.0;
  double gear = 0.0;  ///< −1 reverse, 0 neutral, 1 and so on.
  double accelerator = 0.0, brake = 0.0, clutch = 0.0;
  double fuel_share = 0.0, coolant_temperature_c = 0.0;
  double vertical_mps2 = 0.0;  ///< Acceleration of the body, without gravity.
  double wheel_rotation_hz = 0.0;
  double indicator_left = 0.0, indicator_right = 0.0, high_beam = 0.0, parking_brake = 0.0, anti_lock = 0.0;
};

enum class NumberKind : std::uint8_t { u8, i8, u16, i16, u32, i32, f32, f64 };

/// Place and meaning of one quantity: value = number × scale + offset; with a `bit`, true if that bit is set.
struct TelemetryField {
  double GameTelemetry::*quantity = nullptr;
  std::size_t byte = 0;
  NumberKind kind = NumberKind::f32;
  bool big_endian = false;
  double scale = 1.0, offset = 0.0;
  int bit = -1;
  /// Numbers of the datagram, before scale and offset, for these gears; beside −1 and 0 of the scaled value.
  std::optional<double> reverse, neutral;
};

struct TelemetryFormat {
  std::string name;
  std::size_t least_bytes = 0, most_bytes = 0;
  std::uint16_t port = 0;  ///< The game's default.
  std::vector<TelemetryField> fields;
};

/// "outgauge", "outsim", "codemasters".
const std::vector<TelemetryFormat>& known_telemetry_formats();
Expected<const TelemetryFormat*> find_telemetry_format(std::string_view name);
/// A format as TOML; `name` is used in messages.
Expected<TelemetryFormat> read_telemetry_format(std::string_view toml, std::string_view name);

/// `before`, updated by a datagram.
Expected<GameTelemetry> decode_telemetry(const TelemetryFormat& format, std::span<const std::byte> datagram,
                                         const GameTelemetry& before);

/// Motion to be felt. `before` is the telemetry `seconds` earlier.
CarMotion motion_of(const GameTelemetry& now, const GameTelemetry& before, double seconds);
/// Values for the cluster.
Instruments instruments_of(const GameTelemetry& now);

}  // namespace septet::car_io

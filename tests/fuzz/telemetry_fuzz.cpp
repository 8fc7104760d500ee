// A game's telemetry of any bytes, in each known format and in one made from the first of them: accepted values are
// finite and bounded.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>

#include "car-io/games/telemetry.hpp"

namespace {

using namespace septet::car_io;

void take(const TelemetryFormat& format, std::span<const std::byte> bytes) {
  const auto read = decode_telemetry(format, bytes, {});
  if (!read) {
    if (read.error().what.empty()) std::abort();
    return;
  }
  const CarMotion motion = motion_of(*read, {}, 0.01);
  const Actuators out = actuators_for(motion, {});
  if (!(out.fan >= 0.0 && out.fan <= 1.0 && out.vibration >= 0.0 && out.vibration <= 1.0)) std::abort();
  if (!std::isfinite(instruments_of(*read).speed_kmh)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  for (const TelemetryFormat& format : known_telemetry_formats()) take(format, bytes);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto end = text.find('\0');
  if (const auto own = read_telemetry_format(text.substr(0, end), "fuzz.toml"))
    if (end != std::string_view::npos) take(*own, bytes.subspan(end + 1));
  return 0;
}

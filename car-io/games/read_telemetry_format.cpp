#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "car-io/games/telemetry.hpp"
#include "engine/document/table_reader.hpp"
#include "engine/document/toml_table.hpp"

namespace septet::car_io {
namespace {

using T = GameTelemetry;
constexpr const char* documented_in = "car-io/games/README.md";

constexpr std::pair<std::string_view, double T::*> quantities[] = {{"speed_mps", &T::speed_mps},
                                                                   {"engine_rpm", &T::engine_rpm},
                                                                   {"gear", &T::gear},
                                                                   {"accelerator", &T::accelerator},
                                                                   {"brake", &T::brake},
                                                                   {"clutch", &T::clutch},
                                                                   {"fuel_share", &T::fuel_share},
                                                                   {"coolant_temperature_c", &T::coolant_temperature_c},
                                                                   {"vertical_mps2", &T::vertical_mps2},
                                                                   {"wheel_rotation_hz", &T::wheel_rotation_hz},
                                                                   {"indicator_left", &T::indicator_left},
                                                                   {"indicator_right", &T::indicator_right},
                                                                   {"high_beam", &T::high_beam},
                                                                   {"parking_brake", &T::parking_brake},
                                                                   {"anti_lock", &T::anti_lock}};

constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};

}  // namespace

Expected<TelemetryFormat> read_telemetry_format(std::string_view toml, std::string_view name) {
  const auto document = document::parse_toml(toml, name);
  if (!document) return tl::unexpected(document.error());
  Error error;
  document::TableReader reader(*document, name, "telemetry", error);
  constexpr std::int64_t longest = 65507;
  TelemetryFormat format;
  format.name = reader.get_string("name", "this format");
  format.least_bytes = static_cast<std::size_t>(reader.get_integer("least_bytes", 1, 1, longest));
  format.most_bytes = static_cast<std::size_t>(reader.get_integer("most_bytes", longest, 1, longest));
  format.port = static_cast<std::uint16_t>(reader.get_integer("port", 0, 0, 65535));
  const bool big_endian = reader.get_choice("byte_order", 0, {"little", "big"}) == 1;
  if (const auto* fields = reader.get_table("fields")) {
    document::TableReader names(*fields, name, "telemetry.fields", error);
    for (const auto& [quantity, member] : quantities) {
      const auto* table = names.get_table(quantity);
      if (!table) continue;
      document::TableReader field(*table, name, fmt::format("telemetry.fields.{}", quantity), error);
      TelemetryField result{.quantity = member, .big_endian = big_endian};
      if (!table->contains("byte"))
        field.report("byte", fmt::format("{} has no byte", quantity), "say at which byte of the datagram it begins");
      result.byte = static_cast<std::size_t>(field.get_integer("byte", 0, 0, longest));
      result.kind =
          static_cast<NumberKind>(field.get_choice("type", 6, {"u8", "i8", "u16", "i16", "u32", "i32", "f32", "f64"}));
      result.scale = field.get_double("scale", 1.0, -1e9, 1e9);
      result.offset = field.get_double("offset", 0.0, -1e9, 1e9);
      if (member == &T::gear) {
        if (table->contains("reverse")) result.reverse = field.get_double("reverse", 0.0, -1e9, 1e9);
        if (table->contains("neutral")) result.neutral = field.get_double("neutral", 0.0, -1e9, 1e9);
        if (result.reverse && result.reverse == result.neutral)
          field.report("neutral", "reverse and neutral are one number",
                       "say which of them the game sends, or correct one");
      }
      const std::size_t size = sizes[static_cast<std::size_t>(result.kind)];
      if (table->contains("bit"))
        result.bit = static_cast<int>(field.get_integer("bit", 0, 0, static_cast<std::int64_t>(8 * size) - 1));
      if (result.byte + size > format.most_bytes)
        field.report("byte", fmt::format("{} lies behind the datagram's end", quantity), "correct byte or most_bytes");
      field.finish(documented_in);
      format.fields.push_back(result);
    }
    names.finish(documented_in);
  }
  if (format.least_bytes > format.most_bytes)
    reader.report("least_bytes", "least_bytes is more than most_bytes", "correct one of them");
  if (format.fields.empty()) reader.report("fields", "the format has no fields", "say where speed_mps lies, at least");
  reader.finish(documented_in);
  if (!error.what.empty()) return tl::unexpected(error);
  return format;
}

}  // namespace septet::car_io

#include "engine/world/car_warnings.hpp"

#include <iterator>

#include "engine/world/find_effect.hpp"

namespace septet {
namespace {

constexpr std::uint8_t warnings_version = 1;
constexpr bool CarWarnings::*lamps[] = {&CarWarnings::tyre_pressure, &CarWarnings::anti_lock, &CarWarnings::engine,
                                        &CarWarnings::lamp};

}  // namespace

Bytes encode_car_warnings(const CarWarnings& warnings) {
  std::uint8_t bits = 0;
  for (std::size_t i = 0; i < std::size(lamps); ++i)
    bits = static_cast<std::uint8_t>(bits | (warnings.*lamps[i] ? 1 << i : 0));
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(warnings_version);
  out.put(bits);
  return bytes;
}

Expected<CarWarnings> decode_car_warnings(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  if (in.get<std::uint8_t>() != warnings_version) in.fail();
  const auto bits = in.get<std::uint8_t>();
  if (!in.ok() || in.remaining() != 0 || bits == 0 || bits >> std::size(lamps) != 0)
    return failure("these are no warning lamps", "car warnings keyframe",
                   "check that both programs are of the same build");
  CarWarnings warnings;
  for (std::size_t i = 0; i < std::size(lamps); ++i) warnings.*lamps[i] = (bits >> i & 1) != 0;
  return warnings;
}

CarWarnings car_warnings_of(const Snapshot& snapshot) {
  const EffectKeyframe* found = find_effect(snapshot, car_warning_effect_id, car_warning_keyframe_kind);
  if (!found) return {};
  return decode_car_warnings(found->data).value_or(CarWarnings{});
}

}  // namespace septet

#pragma once
/// Warning lamps of the driver's car for faults, as a snapshot carries them: one EffectKeyframe, present while one is
/// lit. Written down in SNAPSHOT.md. Threads: none of its own.

#include <cstdint>
#include <span>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/snapshot.hpp"

namespace septet {

struct CarWarnings {
  bool tyre_pressure = false, anti_lock = false, engine = false;
  bool lamp = false;  ///< A bulb has failed.

  bool any() const { return tyre_pressure || anti_lock || engine || lamp; }
  bool operator==(const CarWarnings&) const = default;
};

inline constexpr std::uint16_t car_warning_keyframe_kind = 8;
inline constexpr std::uint32_t car_warning_effect_id = 0x04000001;

Bytes encode_car_warnings(const CarWarnings& warnings);
/// Refuses anything that `encode_car_warnings` would not write; safe on hostile bytes.
Expected<CarWarnings> decode_car_warnings(std::span<const std::byte> bytes);
/// Warnings of a snapshot; all dark if it has none, or damaged ones.
CarWarnings car_warnings_of(const Snapshot& snapshot);

}  // namespace septet

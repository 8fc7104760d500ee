#pragma once
/// Still ice on the wire: all of it in one EffectKeyframe, renewed when it changes. The format is written down in
/// ICE.md.

#include <span>

#include "engine/core/expected.hpp"
#include "engine/effects/ice/still_ice.hpp"

namespace septet::ice {

inline constexpr std::uint16_t keyframe_kind = 5;
inline constexpr std::uint32_t effect_id = 0x03000000;
/// Limits: later items are left out.
inline constexpr std::size_t most_slabs = 64, most_rows = 512, most_sheets = 16, most_sheet_points = 256;

/// Lengths to the millimetre, degree-hours to 1/256.
Bytes encode(const StillIce& ice);
/// Error: bytes that `encode` would not write; safe on hostile bytes.
Expected<StillIce> decode(std::span<const std::byte> bytes);

}  // namespace septet::ice

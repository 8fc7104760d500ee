#pragma once
/// Frost and stars of cracks on windscreens as an EffectKeyframe: one for all of a drive (ICE.md). Frost is encoded by
/// its mass in the morning and the mass melted, from which each screen derives its distribution.

#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/effects/ice/glass.hpp"

namespace septet::ice {

inline constexpr std::uint16_t glass_keyframe_kind = 6;
inline constexpr std::uint32_t glass_effect_id = 0x03000001;
/// Limits: later items are left out.
inline constexpr std::size_t most_panes = 64, most_stars = 8;

/// Frost to the gram per square metre, lengths to the millimetre, shares to 1/255. Temperatures of the glass stay with
/// the simulation.
Bytes encode_glass(const std::vector<Pane>& panes);
/// Error: bytes that `encode_glass` would not write; safe on hostile bytes.
Expected<std::vector<Pane>> decode_glass(std::span<const std::byte> bytes);

}  // namespace septet::ice

#pragma once
/// Frost and stars of cracks on windscreens as an EffectKeyframe: one for all of a drive (ICE.md). Frost is told by its mass in
/// the morning and what has melted, so that each screen finds what lies where.

#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/effects/ice/glass.hpp"

namespace septet::ice {

inline constexpr std::uint16_t glass_keyframe_kind = 6;
inline constexpr std::uint32_t glass_effect_id = 0x03000001;
/// More than this is not sent: what comes last is left out.
inline constexpr std::size_t most_panes = 64, most_stars = 8;

/// Frost to the gram per square metre, lengths to the millimetre, shares to 1/255. How warm glass is stays with the simulation.
Bytes encode_glass(const std::vector<Pane>& panes);
/// Refuses anything that `encode_glass` would not write; safe on hostile bytes.
Expected<std::vector<Pane>> decode_glass(std::span<const std::byte> bytes);

}  // namespace septet::ice

#pragma once
/// Soot on walls, on the wire and on a screen. The format is written down in SMOKE.md.
///
/// All soot of a smoke is one EffectKeyframe: the box of cells that have any, in 64 levels, in runs. It is renewed
/// while smoke still leaves more; at rest it costs nothing.

#include "engine/core/expected.hpp"
#include "engine/effects/smoke/smoke_state.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::smoke {

inline constexpr std::uint16_t soot_kind = 3;
inline constexpr std::uint32_t soot_effect_id = 0x00800000;
inline constexpr int soot_levels = 64;
/// Limits: with more cells the keyframe stays as it was.
inline constexpr std::size_t max_soot_cells = 1 << 17, max_soot_bytes = 16 * 1024;

/// A box of cells; x runs fastest.
struct SootKeyframe {
  RigidTransform world_from_box;  ///< Origin at the lower corner.
  float cell_m = 0.5f;
  int nx = 0, ny = 0, nz = 0;
  std::vector<std::uint8_t> level;  ///< 0 to soot_levels − 1; see soot_of.
};

/// State::soot of a level: its square, so that thin layers, which show most, have the finest levels.
inline float soot_of(std::uint8_t level) {
  const float share = static_cast<float>(level) / (soot_levels - 1);
  return share * share;
}

/// Empty where there is no soot of a whole level, or more than the limits allow.
Bytes encode_soot(const State& state);
/// Error: bytes that the encoder would not write; safe on hostile bytes.
Expected<SootKeyframe> decode_soot(std::span<const std::byte> bytes);

}  // namespace septet::smoke

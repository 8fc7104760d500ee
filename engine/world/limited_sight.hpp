#pragma once
/// How far drivers see who see less than `farthest_sight_m`, as a snapshot carries it: one EffectKeyframe, present while there is such a driver. Written
/// down in SNAPSHOT.md. Threads: none of its own.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/snapshot.hpp"

namespace septet {

inline constexpr double farthest_sight_m = 200.0;

/// How much of the road before his front bumper a driver sees: what his speed goes by.
struct LimitedSight {
  ParticipantId driver = 0;
  double seen_m = 0.0;  ///< 0 to farthest_sight_m.

  bool operator==(const LimitedSight&) const = default;
};

inline constexpr std::uint16_t limited_sight_keyframe_kind = 9;
inline constexpr std::uint32_t limited_sight_effect_id = 0x04000002;

/// Ascending by driver.
Bytes encode_limited_sights(std::span<const LimitedSight> sights);
/// Refuses anything that `encode_limited_sights` would not write; safe on hostile bytes.
Expected<std::vector<LimitedSight>> decode_limited_sights(std::span<const std::byte> bytes);
/// How far a driver sees; empty if nothing limits it, or the keyframe is damaged.
std::optional<double> limited_sight_m(const Snapshot& snapshot, ParticipantId driver);

}  // namespace septet

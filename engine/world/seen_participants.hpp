#pragma once
/// Whom the driver's eyes have before them, as a snapshot carries it: one EffectKeyframe, renewed when it changes, present
/// while somebody is near enough. Written down in SNAPSHOT.md. Threads: none of its own.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/snapshot.hpp"

namespace septet {

/// Who is farther away is not looked for.
inline constexpr double looked_for_within_m = 250.0;

/// For so long a driver reckons with somebody whom he has seen and sees no more. Chosen between two findings: drivers
/// forgot vehicles that they had looked at seconds before (Robbins, Allen, Miller and Chapman, PLoS ONE 14(9), 2019,
/// e0222905), and predictions of where vehicles would be after 5 s were inaccurate (Groeger, Whelan, Senserrick and
/// Triggs, Road Safety Research, Policing and Education Conference, Adelaide 2002); both read as abstracts.
inline constexpr double remembered_s = 3.0;

inline constexpr std::uint16_t seen_keyframe_kind = 10;
inline constexpr std::uint32_t seen_effect_id = 0x04000003;

/// Ascending.
Bytes encode_seen(std::span<const ParticipantId> seen);
/// Refuses anything that `encode_seen` would not write; safe on hostile bytes.
Expected<std::vector<ParticipantId>> decode_seen(std::span<const std::byte> bytes);
/// Ascending; empty where nobody has been looked for, so that nothing is known to be hidden, or the keyframe is damaged.
std::optional<std::vector<ParticipantId>> seen_by_driver(const Snapshot& snapshot);

}  // namespace septet

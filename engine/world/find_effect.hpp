#pragma once
/// Effects of which a snapshot has one at most.

#include <algorithm>
#include <cstdint>

#include "engine/world/snapshot.hpp"

namespace septet {

/// Its keyframe; null where the snapshot has none, or one of another kind.
inline const EffectKeyframe* find_effect(const Snapshot& snapshot, std::uint32_t id, std::uint16_t kind) {
  const auto found = std::ranges::find(snapshot.effects, id, &EffectKeyframe::id);
  return found != snapshot.effects.end() && found->kind == kind ? &*found : nullptr;
}

}  // namespace septet

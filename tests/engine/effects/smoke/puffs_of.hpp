#pragma once
/// All smoke of a snapshot at once; a screen keeps its decoded keyframes instead.

#include <span>
#include <vector>

#include "engine/effects/smoke/smoke_keyframe.hpp"

namespace septet::smoke {

/// All smoke of a snapshot at a time. Unreadable keyframes are left out and counted in `refused`.
inline std::vector<Puff> puffs_of(std::span<const EffectKeyframe> effects, double time_s,
                                  std::uint32_t* refused = nullptr) {
  std::vector<Puff> puffs;
  for (const EffectKeyframe& effect : effects) {
    if (effect.kind != keyframe_kind) continue;
    if (const auto keyframe = decode(effect.data))
      add_puffs(*keyframe, time_s, puffs);
    else if (refused)
      ++*refused;
  }
  return puffs;
}

}  // namespace septet::smoke

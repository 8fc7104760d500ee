#pragma once
/// Keyframes of all debris at once; a drive sends each when it is due.

#include <vector>

#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/piece.hpp"

namespace septet::debris {

/// All debris, ascending id, ready for a snapshot.
inline std::vector<EffectKeyframe> effect_keyframes(const State& state) {
  std::vector<EffectKeyframe> result;
  if (!state.shards.empty()) result.push_back({first_effect_id, keyframe_kind, encode(keyframe_of(state.shards))});
  for (const Piece& piece : state.pieces)
    result.push_back({first_effect_id + (piece.id & 0xffffff), keyframe_kind, encode(keyframe_of(piece))});
  return result;
}

}  // namespace septet::debris

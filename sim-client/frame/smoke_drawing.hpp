#pragma once
/// Smoke as a screen draws it: puffs of the keyframes at hand, each moved to the instant shown. One thread.

#include <map>
#include <span>
#include <vector>

#include "engine/effects/smoke/smoke_keyframe.hpp"
#include "engine/instant/frame_input.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::frame {

class SmokeDrawing {
 public:
  /// All puffs of a snapshot at a simulated time.
  std::vector<instant::SmokePuff> draw(std::span<const EffectKeyframe> effects, double simulated_time_s);

 private:
  struct Decoded {
    Tick tick = 0;
    bool readable = false, used = false;
    smoke::Keyframe keyframe;
  };
  std::map<std::uint32_t, Decoded> decoded_;  ///< Cache by effect: each keyframe is read once.
};

}  // namespace septet::frame

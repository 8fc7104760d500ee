#pragma once
/// Keyframes of an effect around the instant that a screen shows.
///
/// A keyframe stays in the snapshots until the next one replaces it, so the ticks that a screen keeps suffice: the
/// newest keyframe at or before the instant, and the first one after it. Pure functions over the history.

#include <vector>

#include "sim-client/frame/tick_history.hpp"

namespace septet::frame {

/// One effect at an instant. The pointers lead into the history.
struct EffectMoment {
  const EffectKeyframe* earlier = nullptr;  ///< Keyframe before `before`; null if it is not kept.
  const EffectKeyframe* before = nullptr;   ///< Null: the effect begins after the instant.
  const EffectKeyframe* after = nullptr;    ///< Null: no newer one has come.
};

/// Effects that exist at a simulated time, ascending id.
std::vector<EffectMoment> effects_at(const TickHistory& history, double simulated_time_s, double tick_s);

}  // namespace septet::frame

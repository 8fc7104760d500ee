#include "sim-client/frame/effect_playout.hpp"

#include <algorithm>

namespace septet::frame {
namespace {

const EffectKeyframe* find(const Snapshot& snapshot, std::uint32_t id) {
  const auto found = std::ranges::lower_bound(snapshot.effects, id, {}, &EffectKeyframe::id);
  return found != snapshot.effects.end() && found->id == id ? &*found : nullptr;
}

EffectMoment moment_of(const std::deque<HistoryTick>& ticks, std::uint32_t id, double simulated_time_s, double tick_s) {
  EffectMoment moment;
  const EffectKeyframe* last = nullptr;
  for (auto entry = ticks.rbegin(); entry != ticks.rend(); ++entry) {
    const EffectKeyframe* keyframe = find(entry->snapshot, id);
    if (!keyframe) {
      if (last) break;  // The effect is younger than this tick.
      continue;
    }
    if (last && keyframe->tick == last->tick) continue;
    last = keyframe;
    if (static_cast<double>(keyframe->tick) * tick_s > simulated_time_s + 1e-6) {
      moment.after = keyframe;
    } else if (!moment.before) {
      moment.before = keyframe;
      if (!moment.after) break;  // At rest, or no newer one: no other is needed.
    } else {
      moment.earlier = keyframe;
      break;
    }
  }
  return moment;
}

}  // namespace

std::vector<EffectMoment> effects_at(const TickHistory& history, double simulated_time_s, double tick_s) {
  std::vector<EffectMoment> moments;
  if (history.empty()) return moments;
  const auto [before, after] = history.around(simulated_time_s + 1e-6);
  const Snapshot& present = before ? before->snapshot : after->snapshot;
  for (const EffectKeyframe& effect : present.effects)
    moments.push_back(moment_of(history.ticks(), effect.id, simulated_time_s, tick_s));
  return moments;
}

}  // namespace septet::frame

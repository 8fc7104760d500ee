#include "engine/simulation/effects/keyframe_schedule.hpp"

#include <algorithm>

#include "engine/core/check.hpp"

namespace septet::simulation {
namespace {

/// Keeps the keyframes of effects still offered, and makes room for new ones.
PublishedEffects carried_over(std::span<const EffectOffer> offers, PublishedEffects& old) {
  PublishedEffects result;
  std::size_t j = 0;
  for (const EffectOffer& offer : offers) {
    SEPTET_CHECK(result.channels.empty() || result.channels.back().id < offer.id, "effect {} after {}", offer.id,
                 result.channels.back().id);
    while (j < old.channels.size() && old.channels[j].id < offer.id) ++j;
    const bool known = j < old.channels.size() && old.channels[j].id == offer.id;
    result.channels.push_back(known ? old.channels[j] : PublishedEffect{offer.id, 0, false});
    result.keyframes.push_back(known ? std::move(old.keyframes[j]) : EffectKeyframe{offer.id, offer.kind, {}, 0});
  }
  return result;
}

}  // namespace

PublishReport publish(std::span<const EffectOffer> offers, Tick shows, const KeyframeLimits& limits,
                      PublishedEffects& published) {
  published = carried_over(offers, published);
  std::vector<std::size_t> due;
  PublishReport report;
  for (std::size_t i = 0; i < offers.size(); ++i) {
    const PublishedEffect& channel = published.channels[i];
    report.total_bytes += published.keyframes[i].data.size();
    const bool fresh = channel.tick == 0, rested = channel.settled && offers[i].settled;
    if (fresh || (!rested && (offers[i].settled || shows >= channel.tick + offers[i].interval_ticks))) due.push_back(i);
  }
  std::ranges::stable_sort(due, {}, [&](std::size_t i) { return published.channels[i].tick; });
  for (const std::size_t i : due) {
    if (report.fresh_bytes >= limits.fresh_bytes) {
      ++report.waiting;
      continue;
    }
    Bytes data = offers[i].encode();
    EffectKeyframe& keyframe = published.keyframes[i];
    const std::size_t total = report.total_bytes - keyframe.data.size() + data.size();
    const bool fits = report.fresh_bytes == 0 || report.fresh_bytes + data.size() <= limits.fresh_bytes;
    if (!fits || total > limits.total_bytes) {
      ++report.waiting;
      continue;
    }
    report.fresh_bytes += data.size();
    report.total_bytes = total;
    ++report.written;
    keyframe.data = std::move(data);
    keyframe.tick = shows;
    published.channels[i].tick = shows;
    published.channels[i].settled = offers[i].settled;
  }
  // An effect that has not had its first turn is not there yet.
  for (std::size_t i = published.channels.size(); i-- > 0;)
    if (published.channels[i].tick == 0) {
      published.channels.erase(published.channels.begin() + static_cast<std::ptrdiff_t>(i));
      published.keyframes.erase(published.keyframes.begin() + static_cast<std::ptrdiff_t>(i));
    }
  return report;
}

}  // namespace septet::simulation

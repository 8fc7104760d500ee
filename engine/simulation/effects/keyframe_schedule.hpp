#pragma once
/// Chooses the effects that get a new keyframe in this tick: a rate for each, an upper limit on bytes for all, turns
/// taken fairly.
///
/// A keyframe stays in every snapshot until the effect's next one replaces it. A resting effect costs nothing after its
/// last one has arrived, and a late joiner gets them all. Where the limit does not suffice, the effects that have
/// waited longest come first. Pure functions over plain data; the same offers give the same keyframes.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/world/snapshot.hpp"

namespace septet::simulation {

/// One effect that exists now.
struct EffectOffer {
  std::uint32_t id = 0;
  std::uint16_t kind = 0;
  Tick interval_ticks = 4;  ///< Interval between its keyframes while it moves.
  bool settled = false;     ///< It looks as in its last offer, and will until this is false.
  std::function<Bytes()> encode;
};

/// The keyframe that screens have of one effect.
struct PublishedEffect {
  std::uint32_t id = 0;
  Tick tick = 0;
  bool settled = false;  ///< The keyframe already shows it at rest.
};

struct PublishedEffects {
  std::vector<EffectKeyframe> keyframes;  ///< Ascending id: the snapshot's list.
  std::vector<PublishedEffect> channels;  ///< Channels of the same ids.
};

struct KeyframeLimits {
  /// New bytes per call, every 1/60 s. They travel in each tick until the screens have acknowledged one.
  std::size_t fresh_bytes = 24 * 1024;
  /// Bytes of all keyframes together, so that a screen without a baseline gets them, and the smoke, in one tick
  /// (net::max_tick_bytes).
  std::size_t total_bytes = 88 * 1024;
};

struct PublishReport {
  std::size_t fresh_bytes = 0;
  std::size_t total_bytes = 0;
  int written = 0;
  int waiting = 0;  ///< Due, but over the limit.
};

/// Brings `published` up to the effects on offer (ascending id), which show the instant `shows`. An effect that is no
/// longer offered is removed at once.
PublishReport publish(std::span<const EffectOffer> offers, Tick shows, const KeyframeLimits& limits,
                      PublishedEffects& published);

}  // namespace septet::simulation

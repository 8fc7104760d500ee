#pragma once
/// Sight of pairs throughout a session: samples at even steps, and each change refined to its tick.

#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"
#include "sim-client/sight/pair_sight.hpp"

namespace septet::sight {

/// Least sight that counts as unobstructed, as a share of the silhouette's light: share times transmittance. 5 % of a
/// silhouette in clear air, or all of it through smoke that leaves 5 % of the contrast, by which the meteorological
/// range of fog is defined (ICAO). 0 stands for any line.
struct Threshold {
  double light = 0.05;

  bool holds(const Sight& sight) const {
    return sight.unobstructed > 0 && sight.share() * sight.transmittance >= light;
  }
};

/// One observer and one target, by number. A two-wheeler's number stands for its rider, on it and thrown off it.
struct DirectedPair {
  ParticipantId observer = 0, target = 0;
  bool operator==(const DirectedPair&) const = default;
};

struct SightSettings {
  std::filesystem::path session;
  double from_s = 0.0, to_s = 0.0;  ///< Within the session.
  int every_ticks = 12;             ///< Ticks from sample to sample, 1 or more.
  bool mirrors = true;
  Threshold threshold;
  RasterSettings raster;
};

/// Sight of a pair at a tick. There is none at ticks at which one of the two is not there.
struct SightRow {
  Tick tick = 0;
  std::size_t pair = 0;                             ///< Index.
  double distance_m = 0.0;                          ///< From the eyes to the middle of the target's box.
  bool observer_left = false, target_left = false;  ///< Whether they are riders who have left their machines.
  Sight straight;
  std::vector<MirrorSight> mirrors;
};

/// Ticks first ≤ tick ≤ last at which a pair's straight sight was unobstructed, the first not before the first sample.
struct Stretch {
  Tick first = 0, last = 0;
};

struct SessionSight {
  std::vector<SightRow> rows;                   ///< By tick, then by pair; with the ticks of changes.
  std::vector<std::vector<Stretch>> stretches;  ///< Indexed by pair.
  double tick_s = 1.0 / 120.0;
  bool stopped = false;
};

/// First tick in (low, high] at which `state` is what it is at `high`, by halving; it is another one at `low`. With
/// several changes between, one of them.
template <class State>
Tick first_changed(Tick low, Tick high, const State& state_at) {
  while (high - low > 1) {
    const Tick middle = low + (high - low) / 2;
    (state_at(middle) ? high : low) = middle;
  }
  return high;
}

/// Sight of these pairs. Works on all of the machine's cores; the result does not depend on their number. `go_on` gets
/// the share that is done, from one thread at a time, and returns false to stop. Errors: damage, a session without a
/// scene, no Embree.
Expected<SessionSight> sight_of(const SightSettings& settings, const std::vector<DirectedPair>& pairs,
                                const std::function<bool(double share)>& go_on);

}  // namespace septet::sight

#include "sim-client/sight/session_sight.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include <glm/geometric.hpp>

#include "engine/core/parallel_for.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/world/rider.hpp"
#include "logging/session/recorded_scene.hpp"
#include "logging/session/session_reader.hpp"
#include "sim-client/frame/effects_drawing.hpp"
#include "sim-client/playback/driver_eye.hpp"
#include "sim-client/playback/session_instants.hpp"

namespace septet::sight {
namespace {

/// What all threads share.
struct SharedWorld {
  SceneParts scene;
  std::unique_ptr<const StandingWorld> standing;
  DriverSeat seat;
};

/// One thread's reading of the session.
class Watcher {
 public:
  static Expected<Watcher> open(const SightSettings& settings, const SharedWorld& shared) {
    auto session = logging::SessionReader::open(settings.session);
    if (!session) return tl::unexpected(session.error());
    auto world = ObservedWorld::create(shared.scene, *shared.standing);
    if (!world) return tl::unexpected(world.error());
    return Watcher(settings, shared, std::make_unique<logging::SessionReader>(std::move(*session)), std::move(*world));
  }

  /// Rows of these pairs at a tick; cheapest for ascending ticks.
  Expected<std::vector<SightRow>> rows_at(Tick tick, const std::vector<DirectedPair>& pairs,
                                          const std::vector<std::size_t>& which, bool with_mirrors) {
    const double instant_s = static_cast<double>(tick) / session_->info().ticks_per_second;
    if (!instants_ || tick < last_) {
      auto instants = playback::SessionInstants::start(*session_, instant_s);
      if (!instants) return tl::unexpected(instants.error());
      instants_.emplace(std::move(*instants));
    }
    last_ = tick;
    const auto world = instants_->at(instant_s);
    if (!world) return tl::unexpected(world.error());
    effects_.show(*world, instants_->history(), instants_->tick_s(), shared_->scene.moving);
    observed_.take(*world, [this](instant::FrameInput& frame) { effects_.add_to(frame); });
    std::vector<SightRow> rows;
    std::optional<ParticipantId> eyes;
    for (const std::size_t n : which) {
      const Participant* observer = find_person(*world, pairs[n].observer);
      const Participant* target = find_person(*world, pairs[n].target);
      if (!observer || !target) continue;
      if (eyes != observer->id) observed_.look_from(observer->id, shared_->seat);
      eyes = observer->id;
      SightRow row{.tick = tick, .pair = n};
      row.observer_left = observer->id != pairs[n].observer, row.target_left = target->id != pairs[n].target;
      row.distance_m = glm::length(box_around(*target).world_from_box.position_m - observed_.eye_m());
      row.straight = straight_sight(observed_, *target, settings_->raster);
      if (with_mirrors && settings_->mirrors)
        row.mirrors = mirror_sights(observed_, *observer, mirrors_of(*observer, *world, shared_->seat), *target,
                                    settings_->raster);
      rows.push_back(std::move(row));
    }
    return rows;
  }

 private:
  Watcher(const SightSettings& settings, const SharedWorld& shared, std::unique_ptr<logging::SessionReader> session,
          ObservedWorld observed)
      : settings_(&settings), shared_(&shared), session_(std::move(session)), observed_(std::move(observed)) {}

  const SightSettings* settings_;
  const SharedWorld* shared_;
  std::unique_ptr<logging::SessionReader> session_;
  ObservedWorld observed_;
  std::optional<playback::SessionInstants> instants_;
  Tick last_ = 0;
  frame::EffectsDrawing effects_;
};

/// Progress of all threads, and whether to go on.
class Progress {
 public:
  Progress(const std::function<bool(double)>& go_on, std::size_t count) : go_on_(go_on), count_(count) {}
  /// Counts one; false: stop.
  bool step() {
    const std::lock_guard lock(mutex_);
    ++done_;
    goes_ = goes_ && go_on_(static_cast<double>(done_) / static_cast<double>(std::max<std::size_t>(1, count_)));
    return goes_;
  }
  bool goes() {
    const std::lock_guard lock(mutex_);
    return goes_;
  }

 private:
  const std::function<bool(double)>& go_on_;
  std::size_t count_, done_ = 0;
  bool goes_ = true;
  std::mutex mutex_;
};

/// Does `jobs` jobs on all cores, each with its thread's watcher: neighbours go to one thread, which reads forward.
template <class Job>
Expected<void> for_each(std::size_t jobs, const SightSettings& settings, const SharedWorld& shared, const Job& job) {
  const std::size_t threads =
      std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, std::max<std::size_t>(1, jobs));
  std::vector<Expected<void>> outcomes(threads);
  parallel_for(threads, [&](std::size_t thread) {
    auto watcher = Watcher::open(settings, shared);
    if (!watcher) {
      outcomes[thread] = tl::unexpected(watcher.error());
      return;
    }
    for (std::size_t n = thread * jobs / threads; n < (thread + 1) * jobs / threads && outcomes[thread]; ++n)
      outcomes[thread] = job(*watcher, n);
  });
  for (const Expected<void>& outcome : outcomes)
    if (!outcome) return outcome;
  return {};
}

/// A change of a pair's state between two samples.
struct Change {
  std::size_t pair = 0;
  Tick low = 0, high = 0;  ///< The last sample before it and the first one after it.
  bool appears = false;
  Tick at = 0;  ///< First tick of the new state.
  SightRow row{};
};

/// Rows of each pair in their order.
std::vector<std::vector<const SightRow*>> by_pair(const std::vector<SightRow>& rows, std::size_t pairs) {
  std::vector<std::vector<const SightRow*>> of_pair(pairs);
  for (const SightRow& row : rows) of_pair[row.pair].push_back(&row);
  return of_pair;
}

std::vector<Change> changes_in(const std::vector<SightRow>& rows, std::size_t pairs, const SightSettings& settings) {
  std::vector<Change> changes;
  const auto of_pair = by_pair(rows, pairs);
  for (std::size_t pair = 0; pair < pairs; ++pair)
    for (std::size_t n = 1; n < of_pair[pair].size(); ++n) {
      const SightRow &before = *of_pair[pair][n - 1], &after = *of_pair[pair][n];
      const bool was = settings.threshold.holds(before.straight), is = settings.threshold.holds(after.straight);
      if (was != is) changes.push_back({pair, before.tick, after.tick, is, after.tick});
    }
  // By time: a thread reads forward.
  std::ranges::stable_sort(changes, {}, &Change::low);
  return changes;
}

std::vector<Stretch> stretches_of(const std::vector<const SightRow*>& rows, const Threshold& threshold) {
  std::vector<Stretch> stretches;
  bool was = false;
  for (const SightRow* row : rows) {
    const bool is = threshold.holds(row->straight);
    if (is && !was) stretches.push_back({row->tick, row->tick});
    if (is || was) stretches.back().last = is ? row->tick : row->tick - 1;
    was = is;
  }
  return stretches;
}

}  // namespace

Expected<SessionSight> sight_of(const SightSettings& settings, const std::vector<DirectedPair>& pairs,
                                const std::function<bool(double)>& go_on) {
  const auto session = logging::SessionReader::open(settings.session);
  if (!session) return tl::unexpected(session.error());
  scene::Store store;
  if (auto restored = logging::restore_scene(*session, store); !restored) return tl::unexpected(restored.error());
  SharedWorld shared{SceneParts(scene::resolve(store)),
                     nullptr,
                     {playback::driver_eye_m(session->info()), playback::rig_of(session->info())}};
  if (shared.scene.moving.prototypes.empty())
    return failure("it keeps no scene, so nothing is known that could hide anybody", settings.session.string(),
                   "take a session that septet drive recorded");
  auto middle = playback::SessionInstants::start(*session, 0.5 * (settings.from_s + settings.to_s));
  if (!middle) return tl::unexpected(middle.error());
  const auto world = middle->at(0.5 * (settings.from_s + settings.to_s));
  if (!world) return tl::unexpected(world.error());
  auto standing = StandingWorld::create(shared.scene, world->participants.empty()
                                                          ? Vec3(0.0)
                                                          : world->participants.front().world_from_vehicle.position_m);
  if (!standing) return tl::unexpected(standing.error());
  shared.standing = std::move(*standing);

  SessionSight result;
  const double ticks_per_second = session->info().ticks_per_second;
  result.tick_s = 1.0 / ticks_per_second;
  std::vector<Tick> ticks;
  const auto last = static_cast<Tick>(std::floor(settings.to_s * ticks_per_second + 1e-6));
  for (auto tick = static_cast<Tick>(std::ceil(settings.from_s * ticks_per_second - 1e-6)); tick <= last;
       tick += static_cast<Tick>(settings.every_ticks))
    ticks.push_back(tick);
  std::vector<std::size_t> all(pairs.size());
  for (std::size_t n = 0; n < all.size(); ++n) all[n] = n;
  // One observer's pairs one after the other: their world is made once an instant.
  std::ranges::stable_sort(all, {}, [&](std::size_t n) { return pairs[n].observer; });

  std::vector<std::vector<SightRow>> sampled(ticks.size());
  Progress progress(go_on, ticks.size());
  auto done = for_each(ticks.size(), settings, shared, [&](Watcher& watcher, std::size_t n) -> Expected<void> {
    if (!progress.goes()) return {};
    auto rows = watcher.rows_at(ticks[n], pairs, all, true);
    if (!rows) return tl::unexpected(rows.error());
    sampled[n] = std::move(*rows);
    progress.step();
    return {};
  });
  if (!done) return tl::unexpected(done.error());
  for (auto& rows : sampled) std::ranges::move(rows, std::back_inserter(result.rows));

  std::vector<Change> changes = changes_in(result.rows, pairs.size(), settings);
  done = for_each(changes.size(), settings, shared, [&](Watcher& watcher, std::size_t n) -> Expected<void> {
    if (!progress.goes()) return {};
    Change& change = changes[n];
    std::optional<Error> error;
    const auto row_at = [&](Tick tick, bool with_mirrors) -> std::optional<SightRow> {
      auto rows = watcher.rows_at(tick, pairs, {change.pair}, with_mirrors);
      if (!rows) error = rows.error();
      if (!rows || rows->empty()) return std::nullopt;
      return std::move(rows->front());
    };
    change.at = first_changed(change.low, change.high, [&](Tick tick) {
      const auto row = row_at(tick, false);
      return (row && settings.threshold.holds(row->straight)) == change.appears;
    });
    if (change.at != change.high)
      if (auto row = row_at(change.at, true)) change.row = std::move(*row);
    if (error) return tl::unexpected(*error);
    return {};
  });
  if (!done) return tl::unexpected(done.error());
  result.stopped = !progress.goes();
  for (Change& change : changes)
    if (change.row.tick == change.at && change.at != change.high) result.rows.push_back(std::move(change.row));
  std::ranges::stable_sort(result.rows, [](const SightRow& a, const SightRow& b) {
    return std::pair(a.tick, a.pair) < std::pair(b.tick, b.pair);
  });
  for (const auto& rows : by_pair(result.rows, pairs.size()))
    result.stretches.push_back(stretches_of(rows, settings.threshold));
  return result;
}

}  // namespace septet::sight

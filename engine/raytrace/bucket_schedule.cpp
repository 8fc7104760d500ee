#include "engine/raytrace/bucket_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/check.hpp"

namespace septet::raytrace {
namespace {

/// Multiple of the expected time of its tiles after which a silent worker is taken for slower than measured.
constexpr double late = 3.0;
constexpr double whole_frame = std::numeric_limits<double>::infinity();

}  // namespace

BucketSchedule::BucketSchedule(std::size_t frames, std::uint32_t tiles_per_frame, const BucketScheduleOptions& options)
    : frames_(frames), tiles_per_frame_(tiles_per_frame), options_(options), costs_(tiles_per_frame), unbegun_(frames) {
  SEPTET_CHECK(tiles_per_frame > 0, "frames of no tiles");
}

BucketSchedule::Frame& BucketSchedule::begin(std::size_t number) {
  const auto [found, fresh] = begun_.try_emplace(number);
  if (fresh) {
    found->second.dealt.resize(tiles_per_frame_), found->second.done.resize(tiles_per_frame_);
    found->second.undealt = found->second.left = tiles_per_frame_;
    --unbegun_;
    while (begun_.contains(next_frame_) || done_frames_.contains(next_frame_)) ++next_frame_;
  }
  return found->second;
}

void BucketSchedule::skip_frame(std::size_t frame) {
  SEPTET_CHECK(frame < frames_ && !begun_.contains(frame), "frame {} of {}", frame, frames_);
  if (!done_frames_.insert(frame).second) return;
  --unbegun_;
  while (begun_.contains(next_frame_) || done_frames_.contains(next_frame_)) ++next_frame_;
}

void BucketSchedule::skip_tile(std::size_t frame, std::uint32_t tile) {
  SEPTET_CHECK(frame < frames_ && tile < tiles_per_frame_, "tile {} of frame {}", tile, frame);
  if (done_frames_.contains(frame)) return;
  Frame& begun = begin(frame);
  if (begun.done[tile]) return;
  begun.done[tile] = begun.dealt[tile] = true;
  begun.done_cost += costs_[tile];
  --begun.undealt;
  if (--begun.left == 0) begun_.erase(frame), done_frames_.insert(frame);
}

std::size_t BucketSchedule::add_worker(std::uint32_t threads) {
  Worker worker;
  worker.threads = std::max(1u, threads);
  workers_.push_back(worker);
  return workers_.size() - 1;
}

void BucketSchedule::remove_worker(std::size_t number) {
  Worker& worker = workers_[number];
  worker.gone = true;
  const auto run = std::exchange(worker.run, std::nullopt);
  const auto frame = run ? begun_.find(run->frame) : begun_.end();
  if (frame == begun_.end()) return;
  for (std::uint32_t tile = run->first; tile < run->end; ++tile) {
    const bool held = std::any_of(workers_.begin(), workers_.end(), [&](const Worker& other) {
      return other.run && other.run->frame == run->frame && other.run->first <= tile && tile < other.run->end;
    });
    if (!held && frame->second.dealt[tile] && !frame->second.done[tile])
      frame->second.dealt[tile] = false, ++frame->second.undealt;
  }
}

void BucketSchedule::was_ready_after(std::size_t number, std::size_t frame, double duration_s) {
  workers_[number].ready_s = duration_s;
  workers_[number].frame = frame;
}

/// Gives the n-th worker the n-th unfinished frame, in turns where frames are fewer than workers.
std::optional<std::size_t> BucketSchedule::likely_first_frame(std::size_t number) const {
  const std::size_t left = frames_ - done_frames_.size();
  if (left == 0) return std::nullopt;
  std::size_t frame = 0;
  for (std::size_t before = number % left; done_frames_.contains(frame) || before-- > 0;) ++frame;
  return frame;
}

double BucketSchedule::speed_of_all() const {
  double speed = 0.0;
  for (const Worker& worker : workers_)
    if (!worker.gone) speed += speed_of(worker);
  return speed;
}

/// Cost a second. A worker not yet measured is taken for as fast, thread by thread, as the others are on average.
double BucketSchedule::speed_of(const Worker& worker) const {
  if (worker.cost > 0.0) return worker.cost / std::max(worker.busy_s, 1e-9);
  double cost_per_s = 0.0, threads = 0.0;
  for (const Worker& other : workers_)
    if (other.cost > 0.0) cost_per_s += other.cost / std::max(other.busy_s, 1e-9), threads += other.threads;
  return threads > 0.0 ? worker.threads * cost_per_s / threads : worker.threads;
}

double BucketSchedule::time_to_ready_s(const Worker& worker, std::size_t frame) const {
  return worker.frame == frame ? 0.0 : worker.ready_s;
}

BucketSchedule::Left BucketSchedule::left_of(const Worker& worker, double now_s) const {
  Left left;
  const TileRun& run = *worker.run;
  const auto frame = begun_.find(run.frame);
  left.first = left.first_unbegun = run.end;
  for (std::uint32_t tile = run.first; frame != begun_.end() && tile < run.end; ++tile) {
    if (frame->second.done[tile]) continue;
    if (left.in_hands == 0) left.first = tile;
    if (left.in_hands < worker.threads) {
      ++left.in_hands;
      left.in_hands_cost += costs_[tile];
    } else {
      if (left.unbegun_cost == 0.0) left.first_unbegun = tile;
      left.unbegun_cost += costs_[tile];
    }
  }
  const double so_far_s = now_s - worker.began_s;
  left.per_s = worker.came > 0.0 ? worker.came / std::max(worker.last_came_s - worker.began_s, 1e-9) : speed_of(worker);
  left.ease = left.per_s / speed_of(worker);
  if (now_s - worker.last_came_s >
      late * std::max<double>(worker.threads, left.in_hands_cost) / left.per_s + worker.ready_s)
    left.per_s = std::max(1.0, worker.came) / std::max(so_far_s, 1e-9);
  return left;
}

bool BucketSchedule::is_over(const Worker& worker) const {
  const auto frame = begun_.find(worker.run->frame);
  if (frame == begun_.end()) return true;
  for (std::uint32_t tile = worker.run->first; tile < worker.run->end; ++tile)
    if (!frame->second.done[tile]) return false;
  return true;
}

/// Takes the first adjoining undealt tiles of [from, end), up to that cost.
TileRun BucketSchedule::take(std::size_t number, std::uint32_t from, std::uint32_t end, double most_cost) {
  Frame& frame = begin(number);
  TileRun run{number, from, 0};
  while (run.first < end && frame.dealt[run.first]) ++run.first;
  double cost = 0.0;
  for (run.end = run.first; run.end < end && cost < most_cost && !frame.dealt[run.end]; ++run.end) {
    cost += costs_[run.end];
    frame.dealt[run.end] = true;
    --frame.undealt;
  }
  return run;
}

std::optional<TileRun> BucketSchedule::undealt_for(std::size_t number) {
  const Worker& worker = workers_[number];
  std::optional<std::size_t> chosen;
  double undealt = static_cast<double>(unbegun_) * tiles_per_frame_;
  for (const auto& [frame, state] : begun_) {
    for (std::uint32_t tile = 0; state.undealt > 0 && tile < tiles_per_frame_; ++tile)
      if (!state.dealt[tile]) undealt += costs_[tile];
    if (state.undealt > 0 && (worker.frame == frame || (!chosen && unbegun_ == 0))) chosen = frame;
  }
  std::size_t workers = 0;
  for (const Worker& each : workers_) workers += each.gone ? 0 : 1;
  double most = whole_frame;
  if (unbegun_ < workers) most = std::max<double>(worker.threads, 0.5 * undealt * speed_of(worker) / speed_of_all());
  const bool is_ready_for_one = worker.frame && *worker.frame < frames_ && !begun_.contains(*worker.frame) &&
                                !done_frames_.contains(*worker.frame);
  if (!chosen && unbegun_ > 0) chosen = is_ready_for_one ? worker.frame : next_frame_;
  if (!chosen) return std::nullopt;
  return take(*chosen, 0, tiles_per_frame_, most);
}

std::optional<TileRun> BucketSchedule::equal_bucket_for(std::size_t number) {
  const std::uint64_t buckets = std::clamp(options_.equal_buckets, 1u, tiles_per_frame_);
  const auto in = [&](std::size_t frame) -> std::optional<TileRun> {
    for (std::uint64_t n = 0; n < buckets; ++n) {
      const std::size_t owner = n % workers_.size();
      if (options_.dealing == Dealing::round_robin && owner != number && !workers_[owner].gone) continue;
      const auto at = [&](std::uint64_t bucket) {
        return static_cast<std::uint32_t>(bucket * tiles_per_frame_ / buckets);
      };
      const TileRun run = take(frame, at(n), at(n + 1), whole_frame);
      if (run.first < run.end) return run;
    }
    return std::nullopt;
  };
  for (auto& [frame, state] : begun_)
    if (state.undealt > 0)
      if (const auto run = in(frame)) return run;
  while (unbegun_ > 0)
    if (const auto run = in(next_frame_)) return run;
  return std::nullopt;
}

/// Takes over the end of the run that would be done last, at a size that lets both end at once.
std::optional<Deal> BucketSchedule::split_for(std::size_t number, double now_s) const {
  const Worker& worker = workers_[number];
  std::optional<Deal> best;
  double longest_s = 0.0;
  for (std::size_t n = 0; n < workers_.size(); ++n) {
    const Worker& other = workers_[n];
    if (n == number || !other.run) continue;
    const Left left = left_of(other, now_s);
    const double time_left_s = (left.unbegun_cost + 0.5 * left.in_hands_cost) / left.per_s;
    if (left.unbegun_cost == 0.0 || time_left_s <= longest_s) continue;
    const double own_per_s = left.ease * speed_of(worker);
    const double share =
        (time_left_s - time_to_ready_s(worker, other.run->frame)) * left.per_s * own_per_s / (left.per_s + own_per_s);
    if (share < 0.5 * std::min(1.0, costs_[other.run->end - 1])) continue;
    const std::vector<bool>& done = begun_.at(other.run->frame).done;
    // Takes one tile at least, and no more than the share.
    std::uint32_t from = other.run->end;
    for (double taken = 0.0; from > left.first_unbegun; --from) {
      if (done[from - 1]) continue;
      if (taken > 0.0 && taken + costs_[from - 1] > share) break;
      taken += costs_[from - 1];
    }
    longest_s = time_left_s;
    best =
        Deal{{other.run->frame, from, other.run->end}, Deal::Shortened{n, {other.run->frame, other.run->first, from}}};
  }
  return best;
}

/// Repeats tiles in another worker's hands where this worker would finish them sooner.
std::optional<TileRun> BucketSchedule::repeat_for(std::size_t number, double now_s) const {
  const Worker& worker = workers_[number];
  const auto cost_of_one = [](const Left& left) {
    return left.in_hands > 0 ? left.in_hands_cost / left.in_hands : 1.0;
  };
  const auto expected_s = [&](const Worker& other, const Left& left) {
    const double takes_s = cost_of_one(left) * other.threads / left.per_s;
    const double since_s = now_s - other.last_came_s;
    return since_s < takes_s ? takes_s - since_s : since_s;
  };
  std::optional<TileRun> best;
  double most_saved_s = 0.0;
  for (std::size_t n = 0; n < workers_.size(); ++n) {
    const Worker& other = workers_[n];
    if (n == number || !other.run) continue;
    const Left left = left_of(other, now_s);
    if (left.in_hands == 0) continue;
    double sooner_s = expected_s(other, left);
    for (const Worker& third : workers_)
      if (&third != &other && third.run && third.run->frame == other.run->frame && third.run->first <= left.first &&
          left.first < third.run->end)
        sooner_s = std::min(sooner_s, expected_s(third, left_of(third, now_s)));
    const double own_per_s = left.ease * speed_of(worker);
    const double saved_s =
        sooner_s - time_to_ready_s(worker, other.run->frame) - cost_of_one(left) * worker.threads / own_per_s;
    if (saved_s <= most_saved_s) continue;
    most_saved_s = saved_s;
    const std::vector<bool>& done = begun_.at(other.run->frame).done;
    std::uint32_t end = left.first;
    while (end < other.run->end && end - left.first < worker.threads && !done[end]) ++end;
    best = TileRun{other.run->frame, left.first, end};
  }
  return best;
}

void BucketSchedule::hold(Worker& worker, const TileRun& run, double now_s) {
  worker.run = run;
  worker.began_s = worker.last_came_s = now_s;
  worker.came = 0.0;
  worker.frame = run.frame;
}

std::optional<Deal> BucketSchedule::deal(std::size_t number, double now_s) {
  Worker& worker = workers_[number];
  SEPTET_CHECK(!worker.run && !worker.gone, "worker {} has a run", number);
  std::optional<Deal> deal;
  if (options_.dealing != Dealing::split) {
    if (const auto run = equal_bucket_for(number)) deal = Deal{*run, std::nullopt};
  } else if (const auto run = undealt_for(number)) {
    deal = Deal{*run, std::nullopt};
  } else if ((deal = split_for(number, now_s))) {
    ++splits_;
    workers_[deal->shortened->worker].run = deal->shortened->run;
  } else if (const auto again = repeat_for(number, now_s)) {
    deal = Deal{*again, std::nullopt};
  }
  if (deal) hold(worker, deal->run, now_s);
  return deal;
}

bool BucketSchedule::finish(std::size_t number, std::size_t frame, std::uint32_t tile, double now_s, double cpu_s) {
  Worker& worker = workers_[number];
  if (worker.run && worker.run->frame == frame && worker.run->first <= tile && tile < worker.run->end) {
    worker.busy_s += now_s - worker.last_came_s;
    worker.last_came_s = now_s;
    worker.cost += costs_[tile];
    worker.came += costs_[tile];
  }
  if (tile < tiles_per_frame_) costs_.learn(tile, cpu_s, worker.machine);
  const auto begun = begun_.find(frame);
  const bool fresh = begun != begun_.end() && tile < tiles_per_frame_ && !begun->second.done[tile];
  if (fresh) {
    if (!begun->second.dealt[tile]) begun->second.dealt[tile] = true, --begun->second.undealt;
    begun->second.done[tile] = true;
    begun->second.done_cost += costs_[tile];
    if (--begun->second.left == 0) begun_.erase(begun), done_frames_.insert(frame);
  } else {
    ++traced_twice_;
  }
  for (Worker& each : workers_)
    if (each.run && each.run->frame == frame && is_over(each)) each.run.reset();
  return fresh;
}

double BucketSchedule::share_of_begun_frames() const {
  double cost = 0.0;
  for (const auto& [number, frame] : begun_) cost += std::min<double>(frame.done_cost, tiles_per_frame_);
  return cost / tiles_per_frame_;
}

}  // namespace septet::raytrace

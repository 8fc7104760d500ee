#pragma once
/// Schedule of a film's buckets: a master deals them to workers of any speed, first come first served. Knows no
/// network, no clock and no picture: time is passed in.
///
/// A frame's pixels are tiles in a fixed order, and a bucket is a run of them. With `Dealing::split` a worker gets a
/// whole frame while more frames than workers are left; then half of the remaining cost times its share of all workers'
/// measured speed. When all is dealt, the run that would end last is split and the free worker takes over its end,
/// again and again, until the last tiles are traced twice rather than waited for. A slow worker therefore delays no
/// other, and a lost one costs no more than it had begun. The other two dealings are those of Johansson et al.,
/// "Distributed Ray Tracing in an Open Source Environment": equal buckets on request, and equal buckets shared out
/// beforehand.
///
/// The length of a run is measured by the cost of its tiles in the frames before (TileCosts), where that is known.
///
/// Tiles are the same bit for bit on every worker, and however often they are traced: the first result counts.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "engine/raytrace/tile_costs.hpp"

namespace septet::raytrace {

enum class Dealing : std::uint8_t {
  split,        ///< Whole frames, then parts of frames by speed, then parts of late runs.
  equal,        ///< Equal buckets to the next free worker, as in the paper.
  round_robin,  ///< Equal buckets, the n-th to worker n modulo their number.
};

/// Tiles first, first + 1, … below end of one frame.
struct TileRun {
  std::size_t frame = 0;
  std::uint32_t first = 0, end = 0;
  bool operator==(const TileRun&) const = default;
};

/// Work that one worker gets, and the run of another worker that is cut for it.
struct Deal {
  struct Shortened {
    std::size_t worker = 0;
    TileRun run;  ///< Rest of that worker's run.
  };
  TileRun run;
  std::optional<Shortened> shortened;
};

struct BucketScheduleOptions {
  Dealing dealing = Dealing::split;
  std::uint32_t equal_buckets = 81;  ///< Buckets of a frame, for `equal` and `round_robin`.
};

/// Not thread-safe. A worker holds at most one run; it is free when its last tile has come, or was taken over.
class BucketSchedule {
 public:
  BucketSchedule(std::size_t frames, std::uint32_t tiles_per_frame, const BucketScheduleOptions& options = {});

  /// Marks frames and tiles that exist already; called before anything is dealt.
  void skip_frame(std::size_t frame);
  void skip_tile(std::size_t frame, std::uint32_t tile);

  /// Returns the new worker's number: 0, 1, … May be called at any time. `threads`: tiles that it traces at once.
  std::size_t add_worker(std::uint32_t threads);
  /// Deals the lost worker's run anew.
  void remove_worker(std::size_t worker);

  /// Work for a worker without a run; null: no work now, ask again later.
  std::optional<Deal> deal(std::size_t worker, double now_s);
  /// Records a tile that has come, and the processor time that it cost (0: unknown). False: it was there already.
  bool finish(std::size_t worker, std::size_t frame, std::uint32_t tile, double now_s, double cpu_s = 0.0);
  /// Records the time that this worker took to prepare for a frame.
  void was_ready_after(std::size_t worker, std::size_t frame, double duration_s);
  /// Frame of which this worker is likely to get tiles first, so that it can prepare; null: all is done.
  std::optional<std::size_t> likely_first_frame(std::size_t worker) const;

  bool is_free(std::size_t worker) const { return !workers_[worker].run && !workers_[worker].gone; }
  /// True if parts of frames, not whole ones, are dealt from now on to this number of workers.
  bool shares_frames(std::size_t workers) const { return options_.dealing != Dealing::split || unbegun_ < workers; }
  bool has_frame(std::size_t frame) const { return done_frames_.contains(frame); }
  bool has_all() const { return done_frames_.size() == frames_; }
  /// Finished part of the frames in progress, by cost: 1 is one frame.
  double share_of_begun_frames() const;
  std::uint64_t splits() const { return splits_; }
  std::uint64_t traced_twice() const { return traced_twice_; }

 private:
  struct Worker {
    std::uint32_t threads = 1;
    bool gone = false;
    std::optional<TileRun> run;
    double began_s = 0.0, last_came_s = 0.0;  ///< Times of this run.
    double came = 0.0;                        ///< Cost of this run's tiles that have come.
    double busy_s = 0.0, cost = 0.0;          ///< Totals of all its runs.
    TileCosts::Machine machine;
    double ready_s = 0.0;
    std::optional<std::size_t> frame;  ///< Frame that it is prepared for.
  };
  struct Frame {
    std::vector<bool> dealt, done;
    std::uint32_t undealt = 0, left = 0;  ///< Tiles not dealt; tiles not done.
    double done_cost = 0.0;
  };
  /// Work that a worker still has: tiles in its hands, and behind them those that it has not begun.
  struct Left {
    std::uint32_t first = 0, in_hands = 0, first_unbegun = 0;
    double in_hands_cost = 0.0, unbegun_cost = 0.0;
    /// Cost a second of its run so far, including the time since its last tile where that is long.
    double per_s = 0.0;
    double ease = 1.0;  ///< Factor by which this run's tiles come faster than its earlier ones did.
  };

  Frame& begin(std::size_t frame);
  TileRun take(std::size_t frame, std::uint32_t from, std::uint32_t end, double most_cost);
  std::optional<TileRun> undealt_for(std::size_t worker);
  std::optional<TileRun> equal_bucket_for(std::size_t worker);
  std::optional<Deal> split_for(std::size_t worker, double now_s) const;
  std::optional<TileRun> repeat_for(std::size_t worker, double now_s) const;
  void hold(Worker& worker, const TileRun& run, double now_s);
  double speed_of(const Worker& worker) const;
  double speed_of_all() const;
  double time_to_ready_s(const Worker& worker, std::size_t frame) const;
  Left left_of(const Worker& worker, double now_s) const;
  bool is_over(const Worker& worker) const;

  std::size_t frames_;
  std::uint32_t tiles_per_frame_;
  BucketScheduleOptions options_;
  TileCosts costs_;
  std::vector<Worker> workers_;
  std::map<std::size_t, Frame> begun_;  ///< Frames begun and not complete.
  std::set<std::size_t> done_frames_;
  std::size_t next_frame_ = 0;  ///< Lowest frame not begun; all below are begun or complete.
  std::size_t unbegun_;
  std::uint64_t splits_ = 0, traced_twice_ = 0;
};

}  // namespace septet::raytrace

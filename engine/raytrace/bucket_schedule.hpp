#pragma once
/// Who traces which pixels of a film: a master deals buckets to workers of any speed, first come first served. Knows no network, no
/// clock and no picture: time is passed in.
///
/// A frame's pixels are tiles in a fixed order, and a bucket is a run of them. In `Dealing::split` a worker gets a whole frame
/// while there are more of them than workers, then as many tiles as its measured speed deserves of half of what is left; when
/// nothing is left, the run that would end last is split, the worker that is free taking over its end, again and again, until the
/// last tiles are traced twice rather than waited for. So a worker that is slow holds nobody up, and one that is lost costs what
/// it had begun. The others are what Johansson et al., "Distributed Ray Tracing in an Open Source Environment", describe:
/// equal buckets, and equal buckets that are shared out beforehand.
///
/// How much a run is, is told by what its tiles cost in the frames before (TileCosts), where that is known.
///
/// Which worker traces a tile changes no bit of it, nor how often it is traced: the first result counts.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "engine/raytrace/tile_costs.hpp"

namespace septet::raytrace {

enum class Dealing : std::uint8_t {
  split,        ///< Frames, then guided by speed, then what is late is split.
  equal,        ///< The paper's: equal buckets to whoever is free.
  round_robin,  ///< Equal buckets, the n-th to worker n modulo their number.
};

/// Tiles first, first + 1, … below end of one frame.
struct TileRun {
  std::size_t frame = 0;
  std::uint32_t first = 0, end = 0;
  bool operator==(const TileRun&) const = default;
};

/// What one worker is to do now, and whose run is shorter for it.
struct Deal {
  struct Shortened {
    std::size_t worker = 0;
    TileRun run;  ///< All that is left to it.
  };
  TileRun run;
  std::optional<Shortened> shortened;
};

struct BucketScheduleOptions {
  Dealing dealing = Dealing::split;
  std::uint32_t equal_buckets = 81;  ///< Of a frame, where they are equal.
};

/// One thread. A worker holds at most one run; it is free when its last tile has come, or was taken over.
class BucketSchedule {
 public:
  BucketSchedule(std::size_t frames, std::uint32_t tiles_per_frame, const BucketScheduleOptions& options = {});

  /// Before anything is dealt: it is there already.
  void skip_frame(std::size_t frame);
  void skip_tile(std::size_t frame, std::uint32_t tile);

  /// At any time. `threads` tiles at once are in its hands. Its number: 0, 1, …
  std::size_t add_worker(std::uint32_t threads);
  /// It is gone: what it holds is dealt anew.
  void remove_worker(std::size_t worker);

  /// What this worker, which has nothing to do, is to do; nothing: to ask again later.
  std::optional<Deal> deal(std::size_t worker, double now_s);
  /// A tile has come, which has cost so much processor time (0: not known). False: it was there already.
  bool finish(std::size_t worker, std::size_t frame, std::uint32_t tile, double now_s, double cpu_s = 0.0);
  /// How long this worker took to make ready for a frame.
  void was_ready_after(std::size_t worker, std::size_t frame, double duration_s);
  /// Of which frame this worker is likely to get tiles first, so that it can make ready before; nothing: all is done.
  std::optional<std::size_t> likely_first_frame(std::size_t worker) const;

  bool is_free(std::size_t worker) const { return !workers_[worker].run && !workers_[worker].gone; }
  /// What is dealt from now on is parts of frames, if there are so many workers.
  bool shares_frames(std::size_t workers) const { return options_.dealing != Dealing::split || unbegun_ < workers; }
  bool has_frame(std::size_t frame) const { return done_frames_.contains(frame); }
  bool has_all() const { return done_frames_.size() == frames_; }
  /// What is done of the frames that are begun and not whole, by cost: 1 is one frame.
  double share_of_begun_frames() const;
  std::uint64_t splits() const { return splits_; }
  std::uint64_t traced_twice() const { return traced_twice_; }

 private:
  struct Worker {
    std::uint32_t threads = 1;
    bool gone = false;
    std::optional<TileRun> run;
    double began_s = 0.0, last_came_s = 0.0;  ///< Of this run.
    double came = 0.0;                        ///< Cost of this run's tiles that have come.
    double busy_s = 0.0, cost = 0.0;          ///< Of all its runs.
    TileCosts::Machine machine;
    double ready_s = 0.0;
    std::optional<std::size_t> frame;  ///< Which it is ready for.
  };
  struct Frame {
    std::vector<bool> dealt, done;
    std::uint32_t undealt = 0, left = 0;  ///< Not dealt; not done.
    double done_cost = 0.0;
  };
  /// What a worker still has to do: tiles in its hands, and behind them those that it has not begun.
  struct Left {
    std::uint32_t first = 0, in_hands = 0, first_unbegun = 0;
    double in_hands_cost = 0.0, unbegun_cost = 0.0;
    double per_s =
        0.0;  ///< Cost a second, as its run has gone so far, the time since its last tile too where that is long.
    double ease = 1.0;  ///< Of its run's tiles: how much faster they have come than this worker's did before.
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
  std::map<std::size_t, Frame> begun_;  ///< Not whole.
  std::set<std::size_t> done_frames_;
  std::size_t next_frame_ = 0;  ///< All below are begun or whole.
  std::size_t unbegun_;
  std::uint64_t splits_ = 0, traced_twice_ = 0;
};

}  // namespace septet::raytrace

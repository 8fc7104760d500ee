#pragma once
/// What a tile will cost, from what the tile at the same place has cost in the frames before: a film's next picture is much like
/// its last. The unit is a frame's mean tile, so that a frame of n tiles costs n, and all that counts tiles counts costs as well.
///
/// What tiles cost on machines of different speed is compared by what each machine needs for a unit. One thread.

#include <cstdint>
#include <vector>

namespace septet::raytrace {

class TileCosts {
 public:
  explicit TileCosts(std::uint32_t tiles) : of_tile_(tiles, 0.0) {}

  /// 1 where nothing is known.
  double operator[](std::uint32_t tile) const { return of_tile_[tile] > 0.0 ? of_tile_[tile] / mean() : 1.0; }

  /// What one machine has measured so far: kept by whoever knows the machine.
  struct Machine {
    double cpu_s = 0.0, cost = 0.0;  ///< Of the same tiles; the latter as it was predicted.
  };
  /// This machine has needed so much processor time for a tile. Anything but a positive number tells nothing.
  void learn(std::uint32_t tile, double cpu_s, Machine& machine);

 private:
  double mean() const { return sum_ / known_; }

  std::vector<double> of_tile_;  ///< 0: not known.
  double sum_ = 0.0, known_ = 0.0;
};

}  // namespace septet::raytrace

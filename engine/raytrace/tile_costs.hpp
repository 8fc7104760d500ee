#pragma once
/// Prediction of a tile's cost from the cost of the tile at the same place in the frames before: a film's next picture
/// is much like its last. The unit is a frame's mean tile, so that a frame of n tiles costs n, and costs can replace
/// counts of tiles.
///
/// Costs on machines of different speed are compared by each machine's time for a unit. One thread.

#include <cstdint>
#include <vector>

namespace septet::raytrace {

class TileCosts {
 public:
  explicit TileCosts(std::uint32_t tiles) : of_tile_(tiles, 0.0) {}

  /// Returns 1 where no cost is known.
  double operator[](std::uint32_t tile) const { return of_tile_[tile] > 0.0 ? of_tile_[tile] / mean() : 1.0; }

  /// Measurements of one machine so far, kept by the caller.
  struct Machine {
    double cpu_s = 0.0, cost = 0.0;  ///< Totals of the same tiles; `cost` as it was predicted.
  };
  /// Learns the processor time that this machine needed for a tile. Only a positive finite number counts.
  void learn(std::uint32_t tile, double cpu_s, Machine& machine);

 private:
  double mean() const { return sum_ / known_; }

  std::vector<double> of_tile_;  ///< Cost by tile; 0: not known.
  double sum_ = 0.0, known_ = 0.0;
};

}  // namespace septet::raytrace

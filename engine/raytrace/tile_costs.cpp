#include "engine/raytrace/tile_costs.hpp"

#include <cmath>

namespace septet::raytrace {

void TileCosts::learn(std::uint32_t tile, double cpu_s, Machine& machine) {
  if (!(cpu_s > 0.0) || !std::isfinite(cpu_s)) return;
  machine.cpu_s += cpu_s;
  machine.cost += (*this)[tile];
  const double cost = cpu_s * machine.cost / machine.cpu_s;
  if (of_tile_[tile] == 0.0) known_ += 1.0;
  sum_ += cost - of_tile_[tile];
  of_tile_[tile] = cost;
}

}  // namespace septet::raytrace

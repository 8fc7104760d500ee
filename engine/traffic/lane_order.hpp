#pragma once
/// Who drives behind whom: per lane, everybody in it from back to front, the corridor's own and the foreign vehicles.
///
/// A vehicle that is changing lanes stands in both. Rebuilt every tick; sorting what was almost sorted a tick ago.

#include <cstdint>
#include <vector>

namespace septet::traffic {

struct LaneEntry {
  double x_m = 0.0;       ///< Front bumper.
  double length_m = 0.0;
  double speed_mps = 0.0;
  std::int32_t vehicle = -1;  ///< Index in the corridor's arrays; −1 for a foreign vehicle.
};

using LaneOrder = std::vector<std::vector<LaneEntry>>;  ///< [lane], ascending x.

}  // namespace septet::traffic

#pragma once
/// Crossings on foot as traffic that drives needs them: where they lie, and who is on them or wants to be.
///
/// Places on a crossing are metres from the kerb on the left of its road (as seen along s), negative on that kerb.

#include <cstdint>

#include "engine/road/road_network.hpp"

namespace septet::traffic {

struct CrossingPlace {
  road::RoadIndex road = 0;
  double s_m = 0.0;       ///< Of its middle.
  double half_m = 0.0;    ///< Half of its extent along the road.
  double left_t_m = 0.0;  ///< Of the kerb on the left, and on the right.
  double right_t_m = 0.0;

  double length_m() const { return left_t_m - right_t_m; }
};

/// Somebody on a crossing, or at its kerb.
struct PersonCrossing {
  std::uint32_t crossing = 0;
  double at_m = 0.0;
  double speed_mps = 0.0;  ///< Towards the right kerb; of who waits the speed at which he would go.
  bool waits = false;      ///< He stands at the kerb and is to be let pass.
};

}  // namespace septet::traffic

#pragma once
/// The fundamental diagram of traffic: flow and speed over density, measured on rings.
///
/// Terms as in M. Treiber and A. Kesting, "Traffic Flow Dynamics" (2013), chapters 3 and 4: density is vehicles per
/// kilometre and lane, flow is density times the mean speed of the vehicles, which on a ring is exact.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/traffic/driver.hpp"

namespace septet::traffic {

struct FlowPoint {
  double density_per_km = 0.0;
  double flow_per_h = 0.0;  ///< Per lane.
  double speed_mps = 0.0;
  double deviation_mps = 0.0;  ///< Standard deviation of the vehicles' speeds: high in waves.
};

struct RingOptions {
  double length_m = 4000.0;
  int lanes = 3;
  double settling_s = 600.0, measuring_s = 300.0;
  double step_s = 0.2;
  std::uint64_t seed = 1;
};

/// One ring for each density, per km and lane, with the motorway's mix of vehicles and drivers.
std::vector<FlowPoint> fundamental_diagram(const RingOptions& options, std::span<const double> densities_per_km);

/// Equal drivers of vehicles this long in equilibrium: the model without differences and waves.
FlowPoint equilibrium_flow(const FollowingParameters& driver, double vehicle_length_m, double density_per_km);

}  // namespace septet::traffic

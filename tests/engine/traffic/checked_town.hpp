#pragma once
/// Traffic in a public town, with what must hold wherever it drives.

#include <cstdint>
#include <string>

#include <doctest/doctest.h>

#include "tests/engine/traffic/public_town.hpp"
#include "tests/engine/traffic/town_run.hpp"

namespace septet::traffic {

/// Checks that no outlines overlap, that nobody stands for three minutes, how often somebody brakes hard, and the
/// acceleration across.
inline TownRun checked_town(const std::string& town, std::uint32_t count, double seconds, std::uint64_t seed) {
  CAPTURE(town);
  CAPTURE(count);
  const road::RoadNetwork network = public_town(town);
  const LaneGraph graph = build_lane_graph(network);
  TownRun run = run_town(network, graph, motorway_traffic(count, 3000.0), seconds, seed, 1.0 / 30.0);
  MESSAGE(run.mean_mps() << " m/s, longest stand " << run.longest_stand_s << " s, hard brakings "
                         << run.hard_brakings / (run.vehicle_s / 3600.0) << " an hour of driving, roads "
                         << run.roads.size());
  CHECK(run.overlaps.empty());
  CHECK(run.longest_stand_s < 180.0);
  CHECK(run.hard_brakings < 1.0 * run.vehicle_s / 3600.0);
  CHECK(run.most_sideways_mps2 < 3.0);  // In bends below most_bend_mps2; more where somebody brakes hard in one.
  return run;
}

}  // namespace septet::traffic

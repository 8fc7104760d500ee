#include <doctest/doctest.h>

#include "tests/engine/traffic/public_town.hpp"
#include "tests/engine/traffic/town_run.hpp"

namespace septet::traffic {

TEST_CASE("in an hour of a public town no outlines overlap and nobody stands for three minutes") {
  for (const std::string town : {"Town01"})
    for (const std::uint32_t count : {40u, 100u}) {
      CAPTURE(town);
      CAPTURE(count);
      const road::RoadNetwork network = public_town(town);
      const LaneGraph graph = build_lane_graph(network);
      const TownRun run = run_town(network, graph, motorway_traffic(count, 3000.0), 3600.0, 21, 1.0 / 30.0);
      MESSAGE(run.mean_mps() << " m/s, longest stand " << run.longest_stand_s << " s, hard brakings "
                             << run.hard_brakings / (run.vehicle_s / 3600.0) << " an hour of driving");
      CHECK(run.overlaps.empty());
      CHECK(run.longest_stand_s < 180.0);
    }
}

}  // namespace septet::traffic

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "tests/engine/traffic/checked_town.hpp"
#include "tests/engine/traffic/dense_run.hpp"
#include "tests/engine/traffic/ring_road.hpp"

namespace septet::traffic {

TEST_CASE("in ten minutes of a public town no outlines overlap and nobody stands for three minutes") {
  for (const char* town : {"Town01", "Town03"})
    for (const std::uint32_t count : {40u, 100u}) checked_town(town, count, 600.0, 11);
}

TEST_CASE("a wreck that lies across a lane of a town's street is passed and touched by nobody") {
  const road::RoadNetwork network = public_town("Town01");
  const LaneGraph graph = build_lane_graph(network);
  const auto length_of = [](const Way& way) { return way.in_junction() ? 0.0 : way.length_m; };
  const auto longest = std::ranges::max_element(graph.ways, {}, length_of);
  const auto way = static_cast<WayIndex>(longest - graph.ways.begin());
  const double at_m = 0.5 * longest->length_m;
  const PlaceOnWay place = place_on_way(graph, *longest, at_m);
  ForeignVehicle wreck;
  wreck.id = 2;
  wreck.model = model_named("saloon");
  wreck.adrift = true;
  wreck.world_from_vehicle = {place.position_m,
                              orientation_from_angles(std::atan2(place.tangent.y, place.tangent.x) + 0.3, 0.0, 0.0)};
  const std::array foreign{wreck};
  const Participant lying = as_participant(wreck);
  std::set<ParticipantId> touches, passed;
  const TownRun run = run_town(
      network, graph, motorway_traffic(60, 3000.0), 900.0, 11, 1.0 / 30.0, foreign,
      [&](const TownState& town, const std::vector<Participant>& participants) {
        for (const Participant& one : participants)
          if (outlines_overlap(one, lying)) touches.insert(one.id);
        for (const TownVehicle& vehicle : town.vehicles)
          if (!vehicle.outside && vehicle.route.front() == way && vehicle.front_m - vehicle.length_m() > at_m + 8.0)
            passed.insert(vehicle.id);
      });
  MESSAGE(passed.size() << " passed it");
  CHECK(touches.empty());
  CHECK(run.overlaps.empty());
  CHECK(passed.size() >= 3);
}

}  // namespace septet::traffic

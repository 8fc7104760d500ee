#include <string>

#include <doctest/doctest.h>

#include "engine/road/opendrive_reader.hpp"
#include "tests/engine/traffic/people/people_run.hpp"
#include "tests/engine/traffic/public_town.hpp"
#include "tests/shipped_files.hpp"

namespace septet::traffic {
namespace {

road::RoadNetwork network_of(const std::string& town) {
  if (town != "town") return public_town(town);
  return road::read_opendrive(shipped_text("scenarios/town/town.xodr"), "town.xodr").value();
}

}  // namespace

TEST_CASE("two hundred people walk ten minutes through no other, and no jam of them lasts") {
  for (const std::string town : {"town", "Town01"}) {
    CAPTURE(town);
    const road::RoadNetwork network = network_of(town);
    const WalkwayGraph graph = walkways(network);
    PeopleAround around;
    around.driver_eyes_m = Vec3(0.5 * (network.low_m + network.high_m), 1.2);
    const PeopleWish wish{200, 200.0};
    PeopleState people = populate_people(wish, graph, around, 7);
    const PeopleRun run = run_people(graph, wish, around, 600.0, people);
    const double there = run.person_s / 600.0, mean_mps = run.walked_m / run.person_s;
    MESSAGE(there << " people, mean " << mean_mps << " m/s, nearest " << run.nearest_m << " m, longest stuck "
                  << run.longest_stuck_s << " s, " << run.crossings_begun << " crossings; " << graph.walks.size()
                  << " walks, " << graph.crossings.size() << " crossings, " << graph.nodes.size() << " nodes, "
                  << graph.posts.size() << " posts");
    CHECK(run.person_s > 600.0 * 170.0);
    CHECK(run.nearest_m > apart_m - 1e-6);
    CHECK(run.longest_stuck_s < 20.0);
    CHECK(mean_mps > 1.0);
  }
}

}  // namespace septet::traffic

/// The shipped scenario with its traffic: the ambulance gets through.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/scenario/scenario_reader.hpp"
#include "engine/scenario/storyboard_runtime.hpp"
#include "engine/traffic/traffic.hpp"
#include "tests/engine/traffic/bodies.hpp"

namespace septet::traffic {
namespace {

std::string content(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("on the motorway everybody makes way for the ambulance and nobody touches anybody") {
  const std::string folder = SEPTET_SOURCE_DIR "/scenarios/motorway-ambulance";
  const auto scenario = scenario::read_scenario(content(folder + "/motorway-ambulance.xosc"), "motorway-ambulance.xosc",
                                                scenario::files_in(folder));
  REQUIRE(scenario.has_value());
  const auto network = road::read_opendrive(content(folder + "/motorway.xodr"), "motorway.xodr");
  REQUIRE(network.has_value());
  for (const std::uint64_t seed : {1, 2, 3}) {
    CAPTURE(seed);
    scenario::StepResult start;
    auto state = scenario::start_scenario(*scenario, *network, scenario::no_entity, start);
    REQUIRE(state.has_value());
    const TrafficParameters parameters =
        motorway_traffic(start.swarms.at(0).vehicle_count, start.swarms.at(0).semi_major_axis_m);
    const auto foreign = [&] {
      std::vector<ForeignVehicle> vehicles;
      for (std::size_t i = 0; i < state->entities.size(); ++i) {
        const auto& entity = state->entities[i];
        vehicles.push_back({static_cast<ParticipantId>(i), scenario->entities[i].model, entity.world_from_entity,
                            entity.velocity_mps, entity.lamps});
      }
      return vehicles;
    };
    Random random(seed);
    TrafficState traffic = populate(parameters, *network, foreign(), random);
    int with_scripted = 0, among_traffic = 0;
    double most_aside = 0.0, hard_braking_s = 0.0, least_mps2 = 0.0;
    const double dt = 1.0 / 60.0;
    for (int tick = 0; tick < 60 * 60; ++tick) {
      scenario::advance_scenario(*scenario, *network, dt, *state);
      advance(parameters, *network, foreign(), dt, random, traffic);
      for (const CorridorTraffic& corridor : traffic.corridors)
        for (const double a : corridor.acceleration_mps2) {
          least_mps2 = std::min(least_mps2, a);
          if (a < -6.0) hard_braking_s += dt;
        }
      for (const double aside : traffic.corridors[0].aside_m) most_aside = std::max(most_aside, std::abs(aside));
      if (tick % 6 != 0) continue;
      std::vector<Participant> scripted, others;
      scenario::append_participants(*scenario, *state, 1, scripted);
      append_participants(traffic, *network, others);
      among_traffic += overlapping_pairs(others);
      for (const Participant& entity : scripted)
        for (const Participant& other : others) with_scripted += overlap(outline(entity), outline(other));
    }
    CHECK(with_scripted == 0);
    CHECK(among_traffic == 0);
    CHECK(most_aside > 0.8);
    const double vehicle_hours = parameters.count / 60.0;
    MESSAGE(hard_braking_s << " s below -6 m/s2, the least " << least_mps2);
    CHECK(hard_braking_s < 0.1 * vehicle_hours);
  }
}

}  // namespace septet::traffic

/// The shipped scenario with its traffic: the ambulance gets through.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/scenario/read/scenario_reader.hpp"
#include "engine/scenario/run/storyboard_runtime.hpp"
#include "engine/traffic/traffic.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/traffic/bodies.hpp"

namespace septet::traffic {
namespace {

std::string content(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Vehicles that have had time to yield to an ambulance behind: near enough, in one lane and moving, for this long.
/// Checks once a tick.
class MakingWayCheck {
 public:
  void look(const CorridorTraffic& traffic, double ambulance_x_m, double dt_s) {
    constexpr double near_m = 150.0, enough_s = 8.0, moves_mps = 8.0, aside_m = 0.3;
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      double& known_s = known_s_[traffic.id[i]];
      const double ahead_m = distance_m(traffic.corridor, ambulance_x_m, traffic.x_m[i]);
      const bool asked = traffic.lane[i] != 0 && traffic.lane[i] == traffic.from_lane[i] && ahead_m > 0.0 &&
                         ahead_m < near_m && traffic.speed_mps[i] > moves_mps;
      known_s = asked ? known_s + dt_s : 0.0;
      if (known_s < enough_s) continue;
      const bool left_most = traffic.lane[i] == traffic.table.lowest;
      ++(left_most ? left_most_ : others_);
      has_not_ += left_most ? traffic.aside_m[i] < aside_m : traffic.aside_m[i] > -aside_m;
    }
  }
  int left_most() const {
    return left_most_;
  }  ///< In the lane to the left of the gap, and in the others: looks at them.
  int others() const { return others_; }
  int has_not() const { return has_not_; }  ///< Counts vehicles that are not aside.

 private:
  std::map<ParticipantId, double> known_s_;
  int left_most_ = 0, others_ = 0, has_not_ = 0;
};

}  // namespace

TEST_CASE("on the motorway everybody makes way for the ambulance and nobody touches anybody") {
  const std::string folder = source_folder() + "/scenarios/behind-ambulance";
  const auto scenario = scenario::read_scenario(content(folder + "/behind-ambulance.xosc"), "behind-ambulance.xosc",
                                                scenario::files_in(folder));
  REQUIRE(scenario.has_value());
  const auto network = road::read_opendrive(content(folder + "/../motorway-ambulance/motorway.xodr"), "motorway.xodr");
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
    double hard_braking_s = 0.0, least_mps2 = 0.0;
    MakingWayCheck making_way;
    const double dt = 1.0 / 60.0;
    for (int tick = 0; tick < 60 * 60; ++tick) {
      scenario::advance_scenario(*scenario, *network, dt, *state);
      advance(parameters, *network, foreign(), dt, random, traffic);
      for (const CorridorTraffic& corridor : traffic.corridors)
        for (const double a : corridor.acceleration_mps2) {
          least_mps2 = std::min(least_mps2, a);
          if (a < -6.0) hard_braking_s += dt;
        }
      for (const auto& entity : state->entities) {
        if (!entity.on_road || !entity.lamps.has(Lamp::beacon)) continue;
        const road::LanePosition& at = entity.lane;
        if (const auto x = x_of(*network, traffic.corridors[0].corridor, {at.road, at.s_m, 0.0}, at.lane))
          making_way.look(traffic.corridors[0], *x, dt);
      }
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
    MESSAGE("looks at who makes way: to the left ", making_way.left_most(), ", to the right ", making_way.others(),
            ", not ", making_way.has_not());
    CHECK(making_way.left_most() > 100);
    CHECK(making_way.others() > 5000);
    CHECK(making_way.has_not() == 0);
    const double vehicle_hours = parameters.count / 60.0;
    MESSAGE(hard_braking_s << " s below -6 m/s2, the least " << least_mps2);
    CHECK(hard_braking_s < 0.1 * vehicle_hours);
  }
}

}  // namespace septet::traffic

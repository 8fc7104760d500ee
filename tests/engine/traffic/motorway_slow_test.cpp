/// The shipped scenario with its traffic: the ambulance gets through.

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/scenario/scenario_reader.hpp"
#include "engine/scenario/storyboard_runtime.hpp"
#include "engine/traffic/traffic.hpp"

namespace septet::traffic {
namespace {

std::string content(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Whether two vehicles' outlines overlap, by the separating axes of their boxes.
bool overlap(const Participant& a, const Participant& b) {
  const auto box = [](const Participant& p) {
    const VehicleModel& model = vehicle_models()[p.model];
    std::array<Vec2, 4> corners;
    int k = 0;
    for (const double x : {-model.rear_overhang_m, model.front_m()}) {
      for (const double y : {-0.5, 0.5}) {
        corners[static_cast<std::size_t>(k++)] =
            Vec2(p.world_from_vehicle * Vec3(x, y * model.width_m, 0.0));
      }
    }
    return corners;
  };
  const auto of_a = box(a), of_b = box(b);
  for (const auto& corners : {of_a, of_b}) {
    for (const Vec2 axis : {corners[2] - corners[0], corners[1] - corners[0]}) {
      double a_low = 1e300, a_high = -1e300, b_low = 1e300, b_high = -1e300;
      for (const Vec2& c : of_a)
        a_low = std::min(a_low, glm::dot(c, axis)), a_high = std::max(a_high, glm::dot(c, axis));
      for (const Vec2& c : of_b)
        b_low = std::min(b_low, glm::dot(c, axis)), b_high = std::max(b_high, glm::dot(c, axis));
      if (a_high < b_low || b_high < a_low) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("on the motorway everybody makes way for the ambulance and nobody touches anybody") {
  const std::string folder = SEPTET_SOURCE_DIR "/scenarios/motorway-ambulance";
  const auto scenario =
      scenario::read_scenario(content(folder + "/motorway-ambulance.xosc"),
                              "motorway-ambulance.xosc", scenario::files_in(folder));
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
        vehicles.push_back({static_cast<ParticipantId>(i), scenario->entities[i].model,
                            entity.world_from_entity, entity.velocity_mps, entity.lamps});
      }
      return vehicles;
    };
    Random random(seed);
    TrafficState traffic = populate(parameters, *network, foreign(), random);
    int with_ambulance = 0, among_traffic = 0;
    double most_aside = 0.0;
    const double dt = 1.0 / 60.0;
    for (int tick = 0; tick < 60 * 60; ++tick) {
      scenario::advance_scenario(*scenario, *network, dt, *state);
      advance(parameters, *network, foreign(), dt, random, traffic);
      for (const double aside : traffic.corridors[0].aside_m)
        most_aside = std::max(most_aside, std::abs(aside));
      if (tick % 6 != 0) continue;
      std::vector<Participant> scripted, others;
      scenario::append_participants(*scenario, *state, 1, scripted);
      append_participants(traffic, *network, others);
      const auto near = [](const Participant& a, const Participant& b) {
        return glm::length(a.world_from_vehicle.position_m - b.world_from_vehicle.position_m) <
               20.0;
      };
      for (std::size_t i = 0; i < others.size(); ++i) {
        if (near(scripted[1], others[i]) && overlap(scripted[1], others[i])) ++with_ambulance;
        for (std::size_t k = i + 1; k < others.size(); ++k) {
          if (near(others[i], others[k]) && overlap(others[i], others[k])) ++among_traffic;
        }
      }
    }
    CHECK(with_ambulance == 0);
    CHECK(among_traffic == 0);
    CHECK(most_aside > 0.8);
  }
}

}  // namespace septet::traffic

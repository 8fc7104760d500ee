#pragma once
/// A road network with its walls and, where a scenario switches them, its lights.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/road/opendrive_reader.hpp"
#include "engine/roadside/obstacles.hpp"
#include "engine/roadside/road_shape.hpp"
#include "engine/scenario/read/scenario_reader.hpp"
#include "engine/simulation/lights_stage.hpp"
#include "engine/simulation/model.hpp"
#include "engine/traffic/network/approach_view.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/traffic/town_run.hpp"
#include "tests/shipped_files.hpp"
#include "tests/why_not.hpp"

namespace septet::traffic {

struct LitTown {
  road::RoadNetwork network;
  LaneGraph graph;
  LightsAt lights_at;  ///< Empty: no lights.
};

/// The graph knows the walls beside the roads.
inline LitTown walled_town(road::RoadNetwork network) {
  LitTown town{std::move(network), {}, {}};
  town.graph = build_lane_graph(town.network);
  look_past_walls(roadside::Obstacles(town.network, 1).walls(), town.graph);
  return town;
}

/// With its lights as a scenario switches them.
inline LitTown lit_town(road::RoadNetwork network, scenario::Scenario scenario) {
  LitTown town = walled_town(std::move(network));
  const auto model = std::make_shared<simulation::Model>();
  model->scenario = std::move(scenario);
  model->lights = simulation::switched_lights(roadside::RoadShape(town.network, roadside::usual_overrun_m),
                                              model->scenario.signals);
  if (!model->lights.empty()) town.lights_at = [model](double time_s) { return simulation::lit_heads(*model, time_s); };
  return town;
}

/// scenarios/town.
inline LitTown shipped_town() {
  auto network = road::read_opendrive(shipped_text("scenarios/town/town.xodr"), "town.xodr");
  REQUIRE_MESSAGE(network.has_value(), why_not(network));
  auto scenario = scenario::read_scenario(shipped_text("scenarios/town/town.xosc"), "town.xosc",
                                          scenario::files_in(source_folder() + "/scenarios/town"));
  REQUIRE_MESSAGE(scenario.has_value(), why_not(scenario));
  LitTown town = lit_town(std::move(*network), std::move(*scenario));
  REQUIRE(town.lights_at);
  return town;
}

}  // namespace septet::traffic

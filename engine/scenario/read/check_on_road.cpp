#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "engine/scenario/read/scenario_reading.hpp"
#include "engine/scenario/run/resolve_position.hpp"
#include "engine/scenario/run/storyboard_runtime.hpp"

namespace septet::scenario {
namespace {

/// Checks the places that the file names directly, anywhere in the storyboard.
void check_named_places(const Reading& reading, const road::RoadNetwork& network) {
  const ScenarioState nobody_anywhere;
  for (const auto& [element, position] : reading.positions) {
    const bool named =
        std::holds_alternative<LaneCoordinates>(position) || std::holds_alternative<RoadCoordinates>(position);
    if (named && !resolve_position(network, nobody_anywhere, position)) {
      element.error(why_nowhere(reading.scenario, network, nobody_anywhere, position),
                    fmt::format("name a place that {} has", reading.scenario.road_file));
    }
  }
}

/// Names vehicles' lights that no phase switches.
void check_lights(const Reading& reading, const road::RoadNetwork& network, const Element& logic_file) {
  constexpr std::size_t most_named = 5;
  std::set<std::string_view> switched;
  for (const SignalController& controller : reading.scenario.signals)
    for (const SignalPhase& phase : controller.phases)
      for (const SignalState& state : phase.states) switched.insert(state.signal);
  std::size_t count = 0;
  std::string names;
  for (const road::Road& road : network.roads)
    for (const road::Signal& signal : road.signals)
      if (signal.is_vehicle_light() && !switched.contains(signal.id) && ++count <= most_named)
        names += (names.empty() ? "" : ", ") + signal.id.substr(0, 40);
  if (count == 0) return;
  logic_file.warning(fmt::format("{} traffic lights of the road have no phase and stay dark: {}{}", count, names,
                                 count > most_named ? ", …" : ""),
                     "switch them by a TrafficSignalController, or expect traffic to go by signs");
}

/// Checks the places of all entities after Init.
void check_start(const Reading& reading, const road::RoadNetwork& network) {
  const Scenario& scenario = reading.scenario;
  StepResult result;
  const auto state = start_scenario(scenario, network, no_entity, result);
  if (!state) {
    const auto at = std::find_if(scenario.init.begin(), scenario.init.end(),
                                 [&](const InitAction& init) { return init.where == state.error().where; });
    if (at != scenario.init.end()) {
      reading.init_elements[static_cast<std::size_t>(at - scenario.init.begin())].error(state.error().what,
                                                                                        state.error().remedy);
    }
    return;
  }
  for (std::size_t i = 0; i < scenario.init.size(); ++i) {
    const InitAction& init = scenario.init[i];
    if (init.entity == no_entity || !std::holds_alternative<TeleportAction>(init.what)) continue;
    const EntityState& entity = state->entities[init.entity];
    if (scenario.entities[init.entity].kind == EntityKind::vehicle && entity.active && !entity.on_road) {
      reading.init_elements[i].warning(fmt::format("{} begins beside every lane", scenario.entities[init.entity].name),
                                       "expect it to drive straight on, or put it on a lane");
    }
  }
}

}  // namespace

void check_on_road(Reading& reading, const Element& logic_file) {
  const std::string& path = reading.scenario.road_file;
  if (path.empty()) return;
  const auto text = reading.files.read(path);
  if (!text) {
    logic_file.error(fmt::format("the road {}: {}", path, text.error().what), text.error().remedy);
    return;
  }
  const auto network = road::read_opendrive(*text, path);
  if (!network) {
    logic_file.error(fmt::format("the road cannot be used: {}", describe(network.error())), "run septet check on it");
    return;
  }
  check_named_places(reading, *network);
  check_lights(reading, *network, logic_file);
  // Init runs only where all of it could be read.
  if (!findings_of(*reading.xml_files.front()).has_error()) check_start(reading, *network);
}

}  // namespace septet::scenario

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

constexpr double longest_s = 1e6;
constexpr std::size_t most_controllers = 1000, most_phases = 1000;

SignalPhase read_phase(const Element& element) {
  SignalPhase phase;
  phase.name = element.label("name");
  phase.duration_s = element.number("duration", 0.0, longest_s);
  for (const Element& each : element.children("TrafficSignalState")) {
    SignalState state{each.text("trafficSignalId"), each.text("state"), {}};
    if (const auto lamps = lamps_of_state(state.state))
      state.lamps = *lamps;
    else
      each.warning(fmt::format("state=\"{}\" is none that is drawn; its lamps are dark", state.state.substr(0, 40)),
                   "write red, amber, green, red-amber, off, or on;off;off");
    phase.states.push_back(std::move(state));
  }
  return phase;
}

}  // namespace

void read_signals(Reading& reading, const Element& signals) {
  struct Reference {
    Element element;
    std::string to;
  };
  std::vector<SignalController>& controllers = reading.scenario.signals;
  std::map<std::string, std::size_t, std::less<>> by_name;
  for (const Element& element : signals.children("TrafficSignalController")) {
    SignalController controller;
    controller.name = element.label("name");
    controller.begins_s = element.number_or("delay", 0.0, 0.0, longest_s);
    for (const Element& phase : element.children("Phase")) controller.phases.push_back(read_phase(phase));
    const std::string reference = element.text_or("reference", "");
    if (!reference.empty()) {
      const auto found = by_name.find(reference);
      if (found == by_name.end())
        element.error(fmt::format("no controller before it is named \"{}\"", reference.substr(0, 60)),
                      "put the one that it refers to before it");
      else
        controller.begins_s += controllers[found->second].begins_s;
    }
    double cycle_s = 0.0;
    for (const SignalPhase& phase : controller.phases) cycle_s += phase.duration_s;
    if (!(cycle_s > 0.0) || controller.phases.size() > most_phases || controllers.size() >= most_controllers) {
      element.error("its phases take no time, or there are too many", "give it phases with durations above 0");
      continue;
    }
    if (!by_name.emplace(controller.name, controllers.size()).second)
      element.error(fmt::format("controller \"{}\" is there twice", controller.name.substr(0, 60)),
                    "give each a name of its own");
    controllers.push_back(std::move(controller));
  }
}

}  // namespace septet::scenario

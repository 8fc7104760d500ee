#include "engine/scenario/model/signal_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace septet::scenario {
namespace {

/// Time is a sum of steps: a phase begins in the step that reaches it.
constexpr double slack_s = 1e-6;

constexpr std::array lamps_from_top{Lamp::signal_red, Lamp::signal_amber, Lamp::signal_green};

Lamps shining(bool red, bool amber, bool green) {
  Lamps lamps;
  lamps.set(Lamp::signal_red, red);
  lamps.set(Lamp::signal_amber, amber);
  lamps.set(Lamp::signal_green, green);
  return lamps;
}

/// "on;off;off"; a head of two lamps has no amber one.
std::optional<Lamps> lamps_one_by_one(std::string_view state) {
  std::array<std::string_view, 3> words;
  std::size_t count = 0;
  while (count < words.size()) {
    const auto end = state.find(';');
    words[count++] = state.substr(0, end);
    if (end == std::string_view::npos) break;
    state.remove_prefix(end + 1);
    if (count == words.size()) return std::nullopt;
  }
  if (count < 2) return std::nullopt;
  Lamps lamps;
  for (std::size_t i = 0; i < count; ++i) {
    if (words[i] != "on" && words[i] != "off") return std::nullopt;
    lamps.set(lamps_from_top[count == 2 && i == 1 ? 2 : i], words[i] == "on");
  }
  return lamps;
}

}  // namespace

std::optional<Lamps> lamps_of_state(std::string_view state) {
  if (state == "off") return Lamps{};
  if (state == "red") return shining(true, false, false);
  if (state == "amber" || state == "yellow") return shining(false, true, false);
  if (state == "green") return shining(false, false, true);
  for (const std::string_view both : {"red-amber", "redAmber", "red-yellow", "redYellow"})
    if (state == both) return shining(true, true, false);
  return lamps_one_by_one(state);
}

PhaseNow phase_at(const SignalController& controller, double time_s) {
  double cycle_s = 0.0;
  for (const SignalPhase& phase : controller.phases) cycle_s += phase.duration_s;
  if (controller.phases.empty() || !(cycle_s > 0.0)) return {};
  const double since_begin_s = time_s + slack_s - controller.begins_s;
  double start_s = controller.begins_s + std::floor(since_begin_s / cycle_s) * cycle_s;
  for (const SignalPhase& phase : controller.phases) {
    if (time_s + slack_s < start_s + phase.duration_s) return {&phase, start_s};
    start_s += phase.duration_s;
  }
  return {&controller.phases.back(), start_s - controller.phases.back().duration_s};
}

const SignalState* signal_state_at(const std::vector<SignalController>& controllers, std::string_view signal,
                                   double time_s) {
  const SignalState* found = nullptr;
  for (const SignalController& controller : controllers) {
    const PhaseNow now = phase_at(controller, time_s);
    if (!now.phase) continue;
    const auto state = std::ranges::find(now.phase->states, signal, &SignalState::signal);
    if (state != now.phase->states.end()) found = &*state;
  }
  return found;
}

}  // namespace septet::scenario

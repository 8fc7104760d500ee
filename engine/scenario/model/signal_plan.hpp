#pragma once
/// States of traffic lights over time: the phases of their controllers (OpenSCENARIO XML 1.3, TrafficSignalController).
///
/// A function of simulated time alone: no state, so that replays, screens and marks agree. A controller goes through
/// its phases without end; before its delay is over it is in its last one, as if it had always run. A controller with a
/// reference begins its delay after that one began. Seconds.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/world/lamps.hpp"

namespace septet::scenario {

struct SignalState {
  std::string signal;  ///< Id in the road file.
  std::string state;   ///< As the file writes it.
  Lamps lamps;
};

struct SignalPhase {
  std::string name;
  double duration_s = 0.0;
  std::vector<SignalState> states;
};

struct SignalController {
  std::string name;
  double begins_s = 0.0;  ///< Start of its first phase; earlier phases follow from it.
  std::vector<SignalPhase> phases;
};

/// The lamps of a signal's state: "off", "red", "amber" (also "yellow"), "green", "red-amber" (also "redAmber",
/// "redYellow", "red-yellow"), or the three lamps from the top, "on;off;off". Empty for another word.
std::optional<Lamps> lamps_of_state(std::string_view state);

/// The phase at that time, and its start. Of a controller with at least one phase that takes time.
struct PhaseNow {
  const SignalPhase* phase = nullptr;
  double since_s = 0.0;
};
PhaseNow phase_at(const SignalController& controller, double time_s);

/// State of a signal at that time, by the last controller that gives one; null without such a controller.
const SignalState* signal_state_at(const std::vector<SignalController>& controllers, std::string_view signal,
                                   double time_s);

}  // namespace septet::scenario

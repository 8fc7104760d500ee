#pragma once
/// States kept in a drive's log, from which the drive can be run or begun again.

#include <memory>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "engine/simulation/state.hpp"
#include "logging/session/session_reader.hpp"
#include "sim-server/drive/server_options.hpp"

namespace septet::server {

/// Simulated time between two kept states. The first one is at this time or, if the drive itself began at a kept state,
/// at its first tick.
inline constexpr double state_kept_every_s = 10.0;

/// The newest state that the session kept until `until_s` (simulated); the drive's start if it kept none until then.
/// `model` and `traffic` are those of the same drive. Error: the state is damaged, forged, of another drive or another
/// build, or another program moves the traffic.
Expected<simulation::State> kept_state(const logging::SessionReader& session, const simulation::Model& model,
                                       double until_s, std::unique_ptr<traffic::TrafficEngine> traffic);

/// The reason why this drive cannot begin again at a state of its own, in words for the operator; empty if it can.
std::optional<std::string> why_no_restart(const ServerOptions& options);

}  // namespace septet::server

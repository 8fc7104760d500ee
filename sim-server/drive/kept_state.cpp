#include "sim-server/drive/kept_state.hpp"

#include <utility>

#include <fmt/core.h>

#include "engine/simulation/saved_state.hpp"
#include "engine/simulation/server_step.hpp"

namespace septet::server {

Expected<simulation::State> kept_state(const logging::SessionReader& session, const simulation::Model& model,
                                       double until_s, std::unique_ptr<traffic::TrafficEngine> traffic) {
  // Simulated time times the tick rate may be a rounding error below the tick.
  constexpr double rounding_ticks = 1e-6;
  const auto saved = session.saved_state(static_cast<Tick>(until_s * simulation::tick_rate_hz + rounding_ticks));
  if (!saved) return tl::unexpected(saved.error());
  if (!*saved) return simulation::initial_state(model, std::move(traffic));
  auto state = simulation::restore_state(model, std::move(traffic), (*saved)->data,
                                         fmt::format("{}, tick {}", session.path().string(), (*saved)->tick));
  if (state && state->tick != (*saved)->tick)
    return failure(fmt::format("the state that was saved at tick {} is that of tick {}", (*saved)->tick, state->tick),
                   session.path().string(), "use an unaltered copy");
  return state;
}

std::optional<std::string> why_no_restart(const ServerOptions& options) {
  if (options.traffic != "own") return "another program moves the traffic, and its state is not kept";
  if (options.log_samples_only) return "only samples are logged, and no state is kept";
  if (!options.page_handover) return "this server was started by itself: only septet drive begins again";
  return std::nullopt;
}

}  // namespace septet::server

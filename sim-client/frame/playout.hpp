#pragma once
/// Instant of the world that a screen shows at a given instant of the server's clock.
///
/// The server gives the offset to subtract from its clock, so that all screens, whatever their network, show the same
/// time at the same instant. Frames are numbered by the server's clock (60 a second): frame n shows the instant n/60 on
/// every screen, however much their clocks differ. The offset holds the play-out delay D, which follows the lateness
/// that the screens report, and the simulation's lag; it changes at an announced instant. Pure functions over the
/// history.

#include <optional>

#include "sim-client/frame/tick_history.hpp"

namespace septet::frame {

inline constexpr double frame_rate_hz = 60.0;

/// Number of the frame whose instant is nearest to this instant of the server's clock.
std::int64_t frame_number(double server_now_s);

/// Simulated time of frame `number`; empty before the first tick.
std::optional<double> playout_time_s(const TickHistory& history, std::int64_t number);

struct PlayedOut {
  Snapshot snapshot;     ///< Interpolated.
  Tick tick = 0;         ///< Tick at or before the shown time: the same on all screens.
  bool on_tick = false;  ///< False: the requested time has not arrived, and an older instant is shown.
};

/// World at a simulated time, as far as the history allows: between two ticks, or the newest one held.
PlayedOut show(const TickHistory& history, double simulated_time_s, double tick_s);

}  // namespace septet::frame

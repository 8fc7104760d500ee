#pragma once
/// Which instant of the world a screen shows at a given instant of the server's clock.
///
/// The server says what to subtract from its clock, so that all screens, whatever their network did, show the same time at
/// the same instant. Frames are numbered by the server's clock (60 a second): frame n shows the instant n/60 on every screen,
/// however much their clocks differ. The offset holds the play-out delay D, which follows the lateness that the screens report,
/// and what the simulation has fallen behind; it changes at an announced instant. Pure functions over the history.

#include <optional>

#include "sim-client/frame/tick_history.hpp"

namespace septet::frame {

inline constexpr double frame_rate_hz = 60.0;

/// The number of the frame to show at this instant of the server's clock: the one whose instant is nearest.
std::int64_t frame_number(double server_now_s);

/// The simulated time that frame `number` shows, or nothing before the first tick.
std::optional<double> playout_time_s(const TickHistory& history, std::int64_t number);

struct PlayedOut {
  Snapshot snapshot;     ///< Interpolated.
  Tick tick = 0;         ///< The tick at or before the shown time: what all screens must agree on.
  bool on_tick = false;  ///< False: nothing as new as the time asked for has arrived, and an older instant is shown.
};

/// The world at a simulated time, as well as the history allows: between two ticks, or the newest one held.
PlayedOut show(const TickHistory& history, double simulated_time_s, double tick_s);

}  // namespace septet::frame

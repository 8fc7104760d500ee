#include "sim-client/frame/playout.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/check.hpp"
#include "engine/world/interpolate.hpp"

namespace septet::frame {

std::int64_t frame_number(double server_now_s) { return std::llround(server_now_s * frame_rate_hz); }

std::optional<double> playout_time_s(const TickHistory& history, std::int64_t number) {
  if (history.empty()) return std::nullopt;
  const control::TickHeader& newest = history.newest().header;
  const double instant_s = static_cast<double>(number) / frame_rate_hz;
  return instant_s - (instant_s >= newest.next_from_s ? newest.next_offset_s : newest.offset_s);
}

PlayedOut show(const TickHistory& history, double simulated_time_s, double tick_s) {
  SEPTET_CHECK(!history.empty(), "no tick to show at {} s", simulated_time_s);
  const auto [before, after] = history.around(simulated_time_s);
  PlayedOut shown;
  if (!before) {  // The instant is older than all kept ticks: the screen has just joined.
    shown.snapshot = after->snapshot;
  } else if (!after) {  // No newer tick is there: the last one is held.
    shown.snapshot = before->snapshot;
    shown.on_tick = simulated_time_s - before->snapshot.simulated_time_s < 1e-6;
  } else {
    // Motion goes on through the gap where a tick is missing: the quintic from tick to tick reaches over several of
    // them.
    shown.snapshot = interpolate(before->snapshot, after->snapshot, simulated_time_s);
    shown.on_tick = true;
  }
  const double since_tick_s = shown.snapshot.simulated_time_s - (before ? before : after)->snapshot.simulated_time_s;
  shown.tick = shown.snapshot.tick + static_cast<Tick>(std::max(0.0, since_tick_s / tick_s + 1e-6));
  return shown;
}

}  // namespace septet::frame

#pragma once
/// The server's loop: one snapshot per tick from the source, to all screens.
///
/// In lockstep simulated time is all there is: every n-th tick is sent and the next one is not taken before all live screens
/// have shown it. In real time a tick is due every 1/rate seconds whatever the screens do. However it ends, the screens are told
/// and the result says why.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "engine/net/udp_socket.hpp"
#include "logging/drive_end.hpp"
#include "sim-server/host/screen_host.hpp"
#include "sim-server/host/tick_source.hpp"

namespace septet::server {

struct ServeOptions {
  bool lockstep = false;
  std::uint64_t draw_every_ticks = 8;  ///< In lockstep.
  std::uint64_t ticks = 0;             ///< 0: until stopped.
  double patience_s =
      60.0;  ///< In lockstep for the screens to be ready at the start (then the drive fails if not one came), and for each frame.
  std::string
      wait_for_driver;  ///< In real time: what to tell a driver for whom the world waits; empty: it begins at once.
  std::string about;    ///< What he reads below that: what he is about to drive; empty: nothing.
  double wait_for_screens_s = 0.0;  ///< The same in real time; then it drives without those that are missing.
  double longest_silence_s =
      10.0;  ///< In lockstep: whoever owes a frame that is not its first, and is not heard either, is left behind.
};

struct Progress {
  double simulated_s = 0.0, total_s = 0.0, wall_s = 0.0;
  std::string what;  ///< "waiting for 3 screens", "driving".
};

/// What the loop needs of the world outside, so that tests run it on simulated time.
struct ServeEnvironment {
  std::function<double()> now_s;
  /// Sleeps until something arrives or the time has passed.
  std::function<void(double seconds)> wait;
  std::function<std::optional<logging::DriveEnd>()> end_requested;  ///< By the operator.
  std::function<void(const Progress&)> report;
  /// What has happened, for the console and the log.
  std::function<void(const std::string&)> message;
  /// The same of the source of ticks, which logs it itself: for the console. May be empty, as those below.
  std::function<void(const std::string&)> show;
  /// Whether the operator wants to drive without those who are missing.
  std::function<bool()> told_to_go;
  /// Called again and again, also while the world stands still, with the newest tick (null before the first) and what is going on: for
  /// whoever looks on. It never waits.
  std::function<void(const std::shared_ptr<const TakenSnapshot>& newest, const std::string& what)> attend;
  /// Each tick as it is taken, for whoever makes it heard. It never waits.
  std::function<void(const std::shared_ptr<const TakenSnapshot>&, double shaking_share)> hear;
  /// Whether the operator wants the world to stand still; asked after `attend`.
  std::function<bool()> is_paused;
  /// What somebody beside the drive says to the driver, as long as he is to read it; empty: nothing.
  std::function<std::string()> word;
  /// The list of allowed clients, where it has changed.
  std::function<std::optional<std::vector<net::AllowedClient>>()> changed_list;
};

struct ServeResult {
  logging::DriveEnd end = logging::DriveEnd::failed;
  std::optional<Error> error;  ///< Where the end is one.
  std::uint64_t ticks = 0;
  double simulated_s = 0.0;
  double wall_s = 0.0;           ///< Without what it stood still.
  std::uint64_t late_ticks = 0;  ///< Real time: ticks that began more than a tick late.
  std::uint64_t state_hash = 0;
};

ServeResult serve(TickSource& source, ScreenHost& host, const ServeOptions& options,
                  const ServeEnvironment& environment);

/// The same without screens: there is nobody to wait for, and ticks follow each other as fast as they are computed.
ServeResult run_headless(TickSource& source, std::uint64_t ticks, const ServeEnvironment& environment);

}  // namespace septet::server

#pragma once
/// The server's loop: one snapshot per tick from the source, to all screens.
///
/// In lockstep there is only simulated time: every n-th tick is sent to screens, and the next one is not taken before all
/// live screens have shown it; clients that watch are sent every tick. In real time a tick is due every 1/rate seconds,
/// regardless of the screens. At any end, the screens are told, and the result has the reason.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "logging/session/drive_end.hpp"
#include "sim-server/host/attendant.hpp"
#include "sim-server/host/screen_host.hpp"
#include "sim-server/host/tick_source.hpp"

namespace septet::server {

struct ServeOptions {
  bool lockstep = false;
  std::uint64_t draw_every_ticks = 8;  ///< In lockstep.
  std::uint64_t ticks = 0;             ///< 0: until stopped.
  /// Lockstep: longest wait for the screens to be ready, which fails if none came; and for each frame.
  double patience_s = 60.0;
  /// Real time: longest wait for the screens; the drive then begins without the missing ones.
  double wait_for_screens_s = 0.0;
  bool can_go_without = false;  ///< An attendant may begin the drive without the screens that are missing.
  /// Text for the driver while the world waits for him, in real time; empty: it begins at once.
  std::string wait_for_driver;
  std::string about;  ///< Text below that, the drive in one line; empty: none.
  /// Text for the driver at the natural end of a drive, in real time; the screens stay for `end_shown_s`, or until a
  /// key ends the drive or begins it again. Empty: they close at once.
  std::function<std::string(logging::DriveEnd)> words_at_end;
  double end_shown_s = 60.0;
  /// Lockstep: a screen that owes a frame (not its first) and is silent for this long is left behind.
  double longest_silence_s = 10.0;
};

/// The loop's clock: the machine's, or a test's.
class ServeClock {
 public:
  virtual ~ServeClock() = default;
  virtual double now_s() const = 0;
  /// Sleeps until something arrives or the time has passed.
  virtual void wait(double seconds) = 0;
};

struct ServeResult {
  logging::DriveEnd end = logging::DriveEnd::failed;
  std::optional<Error> error;  ///< Set if the end is an error.
  std::uint64_t ticks = 0;
  double simulated_s = 0.0;
  double wall_s = 0.0;           ///< Without pauses.
  std::uint64_t late_ticks = 0;  ///< Real time: ticks that began more than a tick late.
  std::uint64_t state_hash = 0;
  bool begins_again = false;  ///< The drive ended naturally, and the driver wants to drive it again.
};

/// Runs the drive. Attendants receive each tick and each message, and their wishes are executed; they have begun, and
/// the caller closes them.
ServeResult serve(TickSource& source, ScreenHost& host, const ServeOptions& options, const Attendants& attendants,
                  ServeClock& clock);

/// Runs the drive without screens: nothing to wait for, so ticks follow each other as fast as they are computed.
ServeResult run_headless(TickSource& source, std::uint64_t ticks, const Attendants& attendants, ServeClock& clock);

}  // namespace septet::server

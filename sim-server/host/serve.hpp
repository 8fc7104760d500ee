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
#include "logging/session/drive_end.hpp"
#include "sim-server/host/attendant.hpp"
#include "sim-server/host/screen_host.hpp"
#include "sim-server/host/tick_source.hpp"

namespace septet::server {

struct ServeOptions {
  bool lockstep = false;
  std::uint64_t draw_every_ticks = 8;  ///< In lockstep.
  std::uint64_t ticks = 0;             ///< 0: until stopped.
  /// Lockstep waits so long for the screens to be ready, and fails where none came; and so long for each frame.
  double patience_s = 60.0;
  /// Real time waits so long for the screens, then drives without those that are missing.
  double wait_for_screens_s = 0.0;
  bool can_go_without = false;  ///< An attendant may begin the drive without the screens that are missing.
  /// Text for a driver for whom the world waits, in real time; empty: it begins at once.
  std::string wait_for_driver;
  std::string about;  ///< Text below that: the drive in a line; empty: none.
  /// Text for the driver at the drive's own end, in real time; the screens stay for `end_shown_s`, or until a key ends or begins
  /// it again. Empty: they close at once.
  std::function<std::string(logging::DriveEnd)> words_at_end;
  double end_shown_s = 60.0;
  /// Lockstep: a screen that owes a frame (not its first) and is silent for this long is left behind.
  double longest_silence_s = 10.0;
};

/// The loop's time: the machine's, or that of a test.
class ServeClock {
 public:
  virtual ~ServeClock() = default;
  virtual double now_s() const = 0;
  /// Sleeps until something arrives or the time has passed.
  virtual void wait(double seconds) = 0;
};

struct ServeResult {
  logging::DriveEnd end = logging::DriveEnd::failed;
  std::optional<Error> error;  ///< Where the end is one.
  std::uint64_t ticks = 0;
  double simulated_s = 0.0;
  double wall_s = 0.0;           ///< Without what it stood still.
  std::uint64_t late_ticks = 0;  ///< Real time: ticks that began more than a tick late.
  std::uint64_t state_hash = 0;
  bool begins_again = false;  ///< It came to its own end, and the driver wants to drive it again.
};

/// The attendants are told of each tick and each message, and what they wish is done; they have begun, and the caller closes them.
ServeResult serve(TickSource& source, ScreenHost& host, const ServeOptions& options, const Attendants& attendants,
                  ServeClock& clock);

/// The same without screens: there is nobody to wait for, and ticks follow each other as fast as they are computed.
ServeResult run_headless(TickSource& source, std::uint64_t ticks, const Attendants& attendants, ServeClock& clock);

}  // namespace septet::server

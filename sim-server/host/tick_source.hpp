#pragma once
/// Where snapshots come from: a drive being simulated, or a session being shown again. Everything after it is the same.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/world/driver_input.hpp"
#include "engine/world/taken_snapshot.hpp"
#include "logging/session/drive_end.hpp"

namespace septet::server {

class TickSource {
 public:
  virtual ~TickSource() = default;
  /// The next tick's snapshot, or nothing at the end. `controls`: what a screen with keyboard or gamepad has sent.
  virtual Expected<std::shared_ptr<const TakenSnapshot>> next(const std::optional<DriverInput>& controls) = 0;
  /// What has gone wrong beside the ticks and ends the drive, also while it waits for its first one: a log that cannot be written. Once.
  virtual std::optional<Error> take_error() { return std::nullopt; }
  /// Why `next` has given nothing, or there is an error.
  virtual logging::DriveEnd end() const = 0;
  /// The world before the first tick, for whoever waits at it; null where nobody does.
  virtual std::shared_ptr<const TakenSnapshot> first() const { return nullptr; }
  /// Whether the driver has taken the controls, `waited_s` after the world began to wait for that.
  virtual bool driver_is_ready(const std::optional<DriverInput>& /*controls*/, double /*waited_s*/) { return true; }
  /// The world stands still from here to the next tick: whatever moves in the driver's seat is to rest.
  /// Called again and again meanwhile.
  virtual void stand_still() {}
  /// What the driver must read on the screen ahead as long as it holds: an emergency stop. Empty: nothing.
  virtual std::string alarm() const { return {}; }
  /// What has just happened to the driver's car, where a person drives it, and what to press; lines. Empty: nothing.
  virtual std::string word_to_driver() const { return {}; }
  /// How much of what shakes the driver may do so: the sound's low frequencies, on which a shaker may hang, go by it. 0: it is cut.
  virtual double shaking_share() const { return 1.0; }
  virtual double tick_rate_hz() const = 0;
  /// What the operator should know since the last call.
  virtual std::vector<std::string> take_messages() { return {}; }
};

}  // namespace septet::server

#pragma once
/// A source of snapshots: a drive being simulated, or a session being replayed. Everything after it is the same.

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
  /// Returns the next tick's snapshot; null at the end. `controls`: from a screen with keyboard or gamepad.
  virtual Expected<std::shared_ptr<const TakenSnapshot>> next(const std::optional<DriverInput>& controls) = 0;
  /// Returns, once, a fault beside the ticks that ends the drive, also during the wait for its first tick: a log that
  /// cannot be written.
  virtual std::optional<Error> take_error() { return std::nullopt; }
  /// Reason for the end, once `next` has returned null or an error.
  virtual logging::DriveEnd end() const = 0;
  /// The world before the first tick, shown while the drive waits; null if it does not wait.
  virtual std::shared_ptr<const TakenSnapshot> first() const { return nullptr; }
  /// True once the driver has taken the controls; `waited_s`: time since the world began to wait.
  virtual bool driver_is_ready(const std::optional<DriverInput>& /*controls*/, double /*waited_s*/) { return true; }
  /// Tells the source that the world stands still until the next tick: all actuators in the driver's seat must rest.
  /// Called repeatedly meanwhile.
  virtual void stand_still() {}
  /// Alarm for the driver on the screen ahead, as long as it holds: an emergency stop. Empty: none.
  virtual std::string alarm() const { return {}; }
  /// Messages about the driver's car, if a person drives it, and the keys to press; one per line. Empty: none.
  virtual std::string word_to_driver() const { return {}; }
  /// Permitted share of vibrations: applies to the sound's low frequencies, which may drive a shaker. 0: cut.
  virtual double shaking_share() const { return 1.0; }
  virtual double tick_rate_hz() const = 0;
  /// Returns messages for the operator since the last call.
  virtual std::vector<std::string> take_messages() { return {}; }
};

}  // namespace septet::server

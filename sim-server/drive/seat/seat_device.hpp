#pragma once
/// A device in the driver's seat beside the controls: a simulated driver, a head tracker, actuators, an instrument cluster. Each is one
/// class in a file of its own; the drive (live_drive.hpp) calls all of them at each tick. None waits for its device. One thread.
///
///     see → the controls are read → add_to → the tick is simulated → actuate → show

#include <optional>
#include <string>

#include "car-io/actuators.hpp"
#include "car-io/can/can_plan.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::server {

class SeatDevice {
 public:
  virtual ~SeatDevice() = default;

  /// Whether it drives: a simulated driver, who moves the controls of the car's device.
  virtual bool drives() const { return false; }
  /// Whether it moves fan, shaker or hand wheel.
  virtual bool moves() const { return false; }
  /// Whether it shows instruments on a cluster that is no screen's.
  virtual bool shows() const { return false; }

  /// The world before a tick.
  virtual void see(const Snapshot& /*before*/) {}
  /// Adds to the controls of the next tick what it measures of the driver.
  virtual void add_to(DriverInput& /*input*/) {}
  /// Moves its actuators; zeros at rest. Returns a fault of them, once.
  virtual std::optional<Error> actuate(Tick /*tick*/, const car_io::Actuators& /*actuators*/) { return std::nullopt; }
  /// Returns a fault of the cluster, once.
  virtual std::optional<Error> show(const car_io::Instruments& /*instruments*/) { return std::nullopt; }
  /// A message for the operator since the last call.
  virtual std::optional<std::string> take_message() { return std::nullopt; }

  /// Whether a CAN bus that was there is lost.
  virtual bool is_lost() const { return false; }
  /// Whether it has cut its actuators by itself, for the drive was silent.
  virtual bool has_cut() const { return false; }
};

}  // namespace septet::server

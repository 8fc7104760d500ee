#pragma once
/// A device in the driver's seat beside the controls: a simulated driver, a head tracker, actuators, an instrument
/// cluster. Each is one class in a file of its own; the drive (live_drive.hpp) calls all of them in each tick. None of
/// them waits for its hardware. One thread.
///
///     see → the controls are read → add_to → the tick is simulated → actuate → show

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "car-io/actuators.hpp"
#include "car-io/can/can_plan.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::server {

class SeatDevice {
 public:
  virtual ~SeatDevice() = default;

  /// True for a simulated driver, who moves the controls of the car's device.
  virtual bool drives() const { return false; }
  /// True if it moves fan, shaker or hand wheel.
  virtual bool moves() const { return false; }
  /// True if it shows instruments on a physical cluster, apart from the screens.
  virtual bool shows() const { return false; }

  /// Takes the world before a tick. `gone`: things of the roadside that do not stand any more, ascending (standing.hpp).
  virtual void see(const Snapshot& /*before*/, std::span<const std::uint32_t> /*gone*/) {}
  /// Adds its measurements of the driver to the controls of the next tick.
  virtual void add_to(DriverInput& /*input*/) {}
  /// Moves its actuators; zeros mean rest. Returns each fault once.
  virtual std::optional<Error> actuate(Tick /*tick*/, const car_io::Actuators& /*actuators*/) { return std::nullopt; }
  /// Shows the instruments on the cluster. Returns each fault once.
  virtual std::optional<Error> show(const car_io::Instruments& /*instruments*/) { return std::nullopt; }
  /// Returns a message for the operator since the last call.
  virtual std::optional<std::string> take_message() { return std::nullopt; }

  /// True if a CAN bus that was there is lost.
  virtual bool is_lost() const { return false; }
  /// True if it has cut its actuators by itself because the drive was silent.
  virtual bool has_cut() const { return false; }
};

}  // namespace septet::server

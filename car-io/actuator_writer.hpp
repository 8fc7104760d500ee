#pragma once
/// Writes the car's output reports from a thread of its own, so that a slow device delays neither its reader nor the
/// simulation.
///
/// The thread opens the device for itself (a HID device may be open several times) and opens it again after an unplug.
/// The latest command is written every `period_s`; without a new one for `silent_after_s`, everything fades to 0 in the
/// same time: a hung simulation does not leave a fan blowing. A `sticky` writer then stays at 0 until the command of
/// rest is set (actuator_guard.hpp), as in a pause: an operator confirms. The destructor writes zeros. For the case
/// that writing becomes impossible, the device's own watchdog is set whenever it is opened, and read back.
///
/// Threads: `set` and `take_error` from any; neither waits for the device.

#include <memory>
#include <optional>

#include "car-io/car_layout.hpp"
#include "car-io/car_report.hpp"
#include "car-io/hid_device.hpp"

namespace septet::car_io {

struct ActuatorWriterOptions {
  const CarLayout* layout = &car_layouts().front();
  bool has_steering_force = false;
  double period_s = 0.01;
  double silent_after_s = 0.2;
  double retry_s = 0.5;
  bool sticky = false;
  bool tells_cut = true;  ///< False: the owner, which polls `is_cut`, reports it.
  double rise_s = 0.0;    ///< Duration of the return after a fault.
};

class ActuatorWriter {
 public:
  /// A layout without actuators starts no thread.
  ActuatorWriter(OpenHidDevice open, const ActuatorWriterOptions& options);
  ~ActuatorWriter();

  void set(const Actuators& actuators);
  /// Sets everything to 0 with the next report, as after a fault: an emergency stop. It stays there until the command
  /// of rest is set.
  void stop();
  /// True while a fault holds everything at 0.
  bool is_cut() const;
  /// Faults to report, each once: a device that is there and takes no output reports, or whose watchdog does not hold;
  /// a sticky writer that was cut. A missing device is reported by its reader.
  std::optional<Error> take_error();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace septet::car_io

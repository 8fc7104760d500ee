#pragma once
/// Writes the car's output reports from a thread of its own, so that a device that takes its time
/// never delays who reads it or who simulates.
///
/// The thread opens the device for itself (a HID device may be open several times) and opens it
/// again after an unplug. What was set last is written every `period_s`; where nobody has set
/// anything for `silent_after_s`, everything fades to 0 in as long again: a simulation that hangs
/// does not leave a fan blowing. A `sticky` writer then stays at 0 until what is at rest is set
/// (actuator_guard.hpp), which is what a pause does: an operator confirms. The destructor writes zeros. For the case that nothing can be
/// written any more, the device's own watchdog is set whenever it is opened, and read back.
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
  bool tells_cut = true;  ///< False: whoever asks `is_cut` says so itself.
  double rise_s = 0.0;    ///< Of what comes back after a fault.
};

class ActuatorWriter {
 public:
  /// A layout without actuators starts no thread.
  ActuatorWriter(OpenHidDevice open, const ActuatorWriterOptions& options);
  ~ActuatorWriter();

  void set(const Actuators& actuators);
  /// Everything to 0 with the next report, as after a fault: an emergency stop. It stays there until what is at rest is set.
  void stop();
  /// Whether a fault holds everything at 0.
  bool is_cut() const;
  /// A device that is there and takes no output reports, or whose watchdog does not hold, once; that a sticky writer was cut;
  /// that it is away is for who reads it to say.
  std::optional<Error> take_error();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace septet::car_io

#pragma once
/// Fan, shaker and hand wheel of a HID device of this machine; a thread writes the output reports.

#include "car-io/actuator_writer.hpp"
#include "sim-server/drive/seat/seat_device.hpp"

namespace septet::server {

class DeviceActuators final : public SeatDevice {
 public:
  /// `is_real_time`: false where a slow tick is no fault: the output then fades during the tick and recovers by itself.
  /// `sticky`: in real time, actuators wait for a pause once cut.
  DeviceActuators(const car_io::OpenHidDevice& open, const car_io::CarLayout& layout, bool has_steering_force,
                  bool is_real_time, bool sticky);

  bool moves() const override { return true; }
  std::optional<Error> actuate(Tick tick, const car_io::Actuators& actuators) override;
  bool has_cut() const override { return is_real_time_ && writer_.is_cut(); }

 private:
  bool is_real_time_;
  car_io::ActuatorWriter writer_;
};

}  // namespace septet::server

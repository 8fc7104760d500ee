#include "sim-server/drive/seat/device_actuators.hpp"

namespace septet::server {

DeviceActuators::DeviceActuators(const car_io::OpenHidDevice& open, const car_io::CarLayout& layout,
                                 bool has_steering_force, bool is_real_time, bool sticky)
    : is_real_time_(is_real_time),
      writer_(open, car_io::ActuatorWriterOptions{.layout = &layout,
                                                  .has_steering_force = has_steering_force,
                                                  .sticky = sticky && is_real_time,
                                                  .rise_s = sticky && is_real_time ? 1.0 : 0.0}) {}

std::optional<Error> DeviceActuators::actuate(Tick, const car_io::Actuators& actuators) {
  writer_.set(actuators);
  return writer_.take_error();
}

}  // namespace septet::server

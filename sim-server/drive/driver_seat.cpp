#include "sim-server/drive/driver_seat.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "car-io/joystick/joystick_controls.hpp"
#include "car-io/usb_device.hpp"
#include "sim-server/drive/seat/device_actuators.hpp"
#include "sim-server/drive/seat/far_actuators.hpp"
#include "sim-server/drive/seat/simulated_person.hpp"
#include "sim-server/host/remote_car.hpp"

namespace septet::server {
namespace {

/// Adds the thread that writes output reports to a device of this machine, within the seat's limits.
void add_device(DriverSeat& seat, const car_io::OpenHidDevice& open, const car_io::CarLayout& layout, bool sticky) {
  seat.devices.push_back(
      std::make_unique<DeviceActuators>(open, layout, seat.actuators.steering_most > 0.0, seat.is_real_time, sticky));
}

/// Adds fan and shaker for a car whose controls come from a bus: the HID device that the rig names.
Expected<void> add_actuators(DriverSeat& seat, const rig::Car& car) {
  const auto layout = car_io::find_car_layout(car.layout);
  if (!layout) return tl::unexpected(layout.error());
  const auto open = car_io::hid_opener(car);
  if (const auto device = open(); !device) {
    Error error = device.error();
    error.remedy += "; or leave [car.actuators] out of the rig, then nothing blows and shakes";
    return tl::unexpected(error);
  }
  seat.actuators = car.actuators;
  seat.steering_lock_rad = car.calibration.steering_lock_rad;
  add_device(seat, open, **layout, true);
  return {};
}

}  // namespace

Expected<DriverSeat> open_driver_seat(const rig::Car& car, std::uint64_t seed,
                                      const std::shared_ptr<const simulation::Model>& model,
                                      const car_io::OpenHidDevice& controls, bool is_real_time) {
  DriverSeat seat;
  seat.is_real_time = is_real_time;
  if (car.source == rig::CarSource::simulated_driver) {
    auto parameters = driver::find_driver(car.driver);
    if (!parameters) return tl::unexpected(parameters.error());
    const vehicle::PowertrainParameters& powertrain = model->car.powertrain;
    parameters->car.has_clutch = powertrain.transmission == vehicle::Transmission::manual;
    parameters->car.gears = powertrain.gear_count;
    for (int gear = 0; gear < powertrain.gear_count; ++gear)
      parameters->car.engine_radps_per_mps[gear] =
          powertrain.gear_ratio[gear] * powertrain.final_ratio / model->car.tyre.radius_m;
    auto person = std::make_unique<SimulatedPerson>(*parameters, seed, model);
    // Septet reads this simulated device like a real one; it has no actuators.
    seat.car = std::make_unique<car_io::CarConnection>(person->opener(), car_io::CarConnectionOptions{});
    seat.devices.push_back(std::move(person));
    return seat;
  }
  if (car.source == rig::CarSource::keyboard) return seat;
  if (car.source == rig::CarSource::can) {
    // Opening the bus now reports a missing one before the drive begins.
    if (const auto bus = controls(); !bus) return tl::unexpected(bus.error());
    seat.car = std::make_unique<car_io::CarConnection>(
        controls,
        car_io::CarConnectionOptions{.calibration = {.steering_lock_rad = car.calibration.steering_lock_rad}});
    if (car.names_actuators)
      if (auto added = add_actuators(seat, car); !added) return tl::unexpected(std::move(added.error()));
    return seat;
  }
  // Joysticks are read with the layout of Septet's own car.
  const bool is_joystick = car.source == rig::CarSource::joystick;
  const auto layout = car_io::find_car_layout(is_joystick ? "septet-car" : car.layout);
  if (!layout) return tl::unexpected(layout.error());
  car_io::CarConnectionOptions options{.layout = *layout, .calibration = car.calibration};
  if (is_joystick) options.calibration = {.steering_lock_rad = car.calibration.steering_lock_rad};
  seat.actuators = car.actuators;
  seat.steering_lock_rad = car.calibration.steering_lock_rad;
  if (!car.machine.empty()) {
    seat.remote = std::make_shared<RemoteCar>();
    options.repeats = true;
    options.retry_s = 0.0;  // Polling the relay is free.
    seat.car = std::make_unique<car_io::CarConnection>(seat.remote->device.opener(), options);
    seat.devices.push_back(std::make_unique<FarActuators>(seat.remote));
    return seat;
  }
  const auto open = car_io::car_opener(car);
  // Opening the device now reports a missing one before the drive begins; a device lost during the drive is reopened.
  if (const auto device = open(); !device) {
    if (car.source == rig::CarSource::automatic) return DriverSeat{};
    Error error = device.error();
    error.remedy += "; or set [car] source = \"automatic\", then a keyboard drives";
    return tl::unexpected(error);
  }
  sit_at_device(seat, open, options, true);
  return seat;
}

void sit_at_device(DriverSeat& seat, const car_io::OpenHidDevice& open, const car_io::CarConnectionOptions& options,
                   bool sticky) {
  seat.car = std::make_unique<car_io::CarConnection>(open, options);
  add_device(seat, open, *options.layout, sticky);
}

}  // namespace septet::server

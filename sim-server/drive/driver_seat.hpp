#pragma once
/// The source of driving: a simulated driver behind the HID interface, a person at a HID device, or a screen's
/// keyboard.

#include <memory>
#include <string>

#include "engine/core/expected.hpp"
#include "engine/rig/rig.hpp"
#include "sim-server/drive/live_drive.hpp"

namespace septet::server {

/// The seat that the rig's `source` names. An automatic source without its device becomes a seat at a keyboard. Error:
/// the device of any other source is missing, or there is no such simulated driver. `is_real_time`: the drive follows
/// the wall clock, so that a silent simulation is a fault. `controls` opens the CAN bus of a rig whose controls come
/// from one.
Expected<DriverSeat> open_driver_seat(const rig::Car& car, std::uint64_t seed,
                                      const std::shared_ptr<const simulation::Model>& model,
                                      const car_io::OpenHidDevice& controls = {}, bool is_real_time = true);

/// Reads a device of this machine and moves its actuators, within the seat's limits. `sticky`: once cut, they wait for
/// a pause.
void sit_at_device(DriverSeat& seat, const car_io::OpenHidDevice& open, const car_io::CarConnectionOptions& options,
                   bool sticky = false);

}  // namespace septet::server

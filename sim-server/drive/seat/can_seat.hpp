#pragma once
/// The rig's CAN bus, of instruments and controls: its DBC file read, its interface opened.

#include <filesystem>
#include <memory>
#include <optional>

#include "car-io/hid_device.hpp"
#include "engine/core/expected.hpp"
#include "engine/rig/rig.hpp"
#include "sim-server/drive/seat/seat_device.hpp"

namespace septet::server {

struct CanSeat {
  std::unique_ptr<SeatDevice> instruments;  ///< Null: the DBC file has none, or there is no bus.
  car_io::OpenHidDevice controls;           ///< Of a rig whose car's source is its CAN bus.
  std::optional<Error> notice;              ///< What of the DBC file is not read, which the rig does not use.
};

/// `rig_file`: beside it lies the DBC file. A rig without CAN is a seat without. Error: the file cannot be read or means nothing. An
/// interface that is not there is told while the drive goes on without instruments.
Expected<CanSeat> open_can_seat(const rig::Rig& rig, const std::filesystem::path& rig_file);

}  // namespace septet::server

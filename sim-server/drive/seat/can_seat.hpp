#pragma once
/// The rig's CAN bus, for instruments and controls: the DBC file is read, the interface opened.

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
  car_io::OpenHidDevice controls;           ///< Set if the source of the rig's car is the CAN bus.
  std::optional<Error> notice;              ///< Parts of the DBC file that Septet cannot read and the rig does not use.
};

/// `rig_file`: the DBC file is in the same folder. A rig without CAN has an empty seat. Error: the file cannot be read
/// or has errors. A missing interface is reported during the drive, which goes on without instruments.
Expected<CanSeat> open_can_seat(const rig::Rig& rig, const std::filesystem::path& rig_file);

}  // namespace septet::server

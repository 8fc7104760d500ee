#pragma once
/// The driver's car on another machine: between the lane that carries its reports and the drive that reads them.

#include <optional>
#include <utility>

#include "car-io/relayed_device.hpp"
#include "engine/control/control_message.hpp"

namespace septet::server {

/// Name of the car's key in allowed-clients.
inline constexpr const char* car_client_name = "car";

struct RemoteCar {
  car_io::RelayedDevice device;
  std::optional<control::CarFeedback> feedback;  ///< Newest feedback not yet sent.

  std::optional<control::CarFeedback> take_feedback() { return std::exchange(feedback, std::nullopt); }
};

}  // namespace septet::server

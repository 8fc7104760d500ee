#pragma once
/// The car's HID device on another machine: reports that come over the network stand in for those
/// of a device here, so that the server reads near and far cars alike.
///
/// Whoever has the connection says what came (`receive`) and when it broke (`lose`); who reads
/// opens the device as any other. Reading returns the newest report; a far device that is away
/// returns why. Threads: one at a time, both ends together.

#include <cstdint>
#include <memory>
#include <string>

#include "car-io/hid_device.hpp"

namespace septet::car_io {

class RelayedDevice {
 public:
  RelayedDevice();

  /// `number` counts on the far side: what is older than the newest is late and does not count. An
  /// empty report with a problem says that the device is away.
  void receive(std::uint32_t number, Bytes report, const std::string& problem);
  /// The connection has gone; the next one counts anew.
  void lose(const std::string& why);

  OpenHidDevice opener() const;

  struct Cable;

 private:
  std::shared_ptr<Cable> cable_;
};

}  // namespace septet::car_io

#pragma once
/// The car's HID device on another machine: reports from the network stand in for those of a local device, so that the
/// server reads near and far cars alike.
///
/// The owner of the connection calls `receive` and `lose`; the reader opens the device as any other. Reading returns
/// the newest report, or the reason of a missing far device. Threads: one at a time, both ends together.

#include <cstdint>
#include <memory>
#include <string>

#include "car-io/hid_device.hpp"

namespace septet::car_io {

class RelayedDevice {
 public:
  RelayedDevice();

  /// `number` counts on the far side: reports older than the newest are dropped. An empty report with a problem means
  /// that the device is away.
  void receive(std::uint32_t number, Bytes report, const std::string& problem);
  /// The connection has gone; the next one counts afresh.
  void lose(const std::string& why);

  OpenHidDevice opener() const;

  struct Cable;

 private:
  std::shared_ptr<Cable> cable_;
};

}  // namespace septet::car_io

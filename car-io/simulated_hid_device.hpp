#pragma once
/// A HID device without hardware: a port into which the program plugs one, opened like any other.
///
/// Behaves as Linux' hidraw does: the oldest 63 reports are kept and newer ones are dropped, an unplugged device stays
/// dead for its holder, and a replugged one is a new device. Threads: any; each open device one at a time, as a real
/// one.

#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "car-io/hid_device.hpp"

namespace septet::car_io {

class SimulatedHidPort {
 public:
  SimulatedHidPort();
  /// Plugs a device in (a new one if one is in) or pulls it out.
  void plug();
  void unplug();

  // The device's side.
  /// Sends an input report; returns false if it was dropped because the earlier ones were not read.
  bool send(std::span<const std::byte> report);
  /// Output reports since the last call.
  std::vector<Bytes> take_written();
  /// Simulates a device that takes no output reports: writing blocks until it does again or is unplugged.
  void block_writes(bool block);
  std::optional<Bytes> feature(std::uint8_t id) const;

  // The program's side. A device may outlive its port.
  Expected<std::unique_ptr<HidDevice>> open() const;
  OpenHidDevice opener() const;

  struct Plugged;

 private:
  struct Socket;
  std::shared_ptr<Socket> socket_;
};

}  // namespace septet::car_io

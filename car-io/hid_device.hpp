#pragma once
/// A HID device, such as the driver's car: the semantics of hidapi behind an interface that a simulated device
/// implements, too.
///
/// Reports carry their id in byte 0 (a device without ids: the bytes as they come). Threads: one thread at a time.
/// Errors: an unplugged device returns an Error from every call and stays dead; close it and open it again, since it
/// comes back as another one.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"

namespace septet::car_io {

class HidDevice {
 public:
  virtual ~HidDevice() = default;

  /// Drains all pending reports and returns the newest; empty if none is pending. Never blocks. The kernel keeps the
  /// oldest reports and drops new ones without a reader, so that this belongs into every tick.
  virtual Expected<std::optional<Bytes>> read_newest() = 0;
  /// Sends an output report. May block on a device that takes none: not for the thread of the simulation.
  virtual Expected<void> write(std::span<const std::byte> report) = 0;
  /// The feature report with this id, `size` bytes long with its id.
  virtual Expected<Bytes> get_feature(std::uint8_t id, std::size_t size) = 0;
  virtual Expected<void> send_feature(std::span<const std::byte> report) = 0;
};

/// Opens a device, or returns the reason; called again after an unplug.
using OpenHidDevice = std::function<Expected<std::unique_ptr<HidDevice>>()>;

struct HidAddress {
  std::uint16_t vendor_id = 0x1209, product_id = 0x0001;
  std::string serial;  ///< Empty: any.
};

/// The device through hidapi (the hidraw backend of Linux).
Expected<std::unique_ptr<HidDevice>> open_hid_device(const HidAddress& address);
/// The same by node, such as /dev/hidraw3.
Expected<std::unique_ptr<HidDevice>> open_hid_node(const std::string& node);

}  // namespace septet::car_io

#pragma once
/// A HID device, as the driver's car is one: the semantics of hidapi behind a seam that a simulated
/// device fills, too.
///
/// Reports carry their id in byte 0 (a device without ids: the bytes as they come). Threads: one
/// thread at a time. Errors: a device that was unplugged returns an Error from every call and stays
/// dead; close it and open it anew, for it comes back as another one.

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

  /// Takes all reports that wait and returns the newest, or nothing where none waits. Never blocks.
  /// The kernel keeps the oldest reports and drops new ones when nobody reads, so that this belongs
  /// into every tick.
  virtual Expected<std::optional<Bytes>> read_newest() = 0;
  /// Sends an output report. May block on a device that takes none: not for the thread of the
  /// simulation.
  virtual Expected<void> write(std::span<const std::byte> report) = 0;
  /// The feature report with this id, `size` bytes long with its id.
  virtual Expected<Bytes> get_feature(std::uint8_t id, std::size_t size) = 0;
  virtual Expected<void> send_feature(std::span<const std::byte> report) = 0;
};

/// Opens a device, or says why not; called again after an unplug.
using OpenHidDevice = std::function<Expected<std::unique_ptr<HidDevice>>()>;

struct HidAddress {
  std::uint16_t vendor_id = 0x1209, product_id = 0x0001;
  std::string serial;  ///< Empty: any.
};

/// The device through hidapi (the hidraw backend of Linux).
Expected<std::unique_ptr<HidDevice>> open_hid_device(const HidAddress& address);
/// The same of a node, such as /dev/hidraw3.
Expected<std::unique_ptr<HidDevice>> open_hid_node(const std::string& node);

}  // namespace septet::car_io

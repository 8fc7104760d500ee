#pragma once
/// A wheel's motor by HID PID reports, for wheels whose force the kernel's own driver does not know (Linux 6.1: many of
/// HID PID) or may not reach.
///
/// Each effect lasts 250 ms unless it is started again: the device's own watchdog, for a program that hangs. One
/// thread. Errors: a device that was unplugged returns an Error from every call; create another one then.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "car-io/hid_device.hpp"
#include "car-io/pid/pid_reports.hpp"

namespace septet::car_io {

/// Effects that a wheel computes itself, a thousand times a second.
enum class PidCondition : std::uint8_t { spring, damper, friction };

class PidWheel {
 public:
  PidWheel(std::unique_ptr<HidDevice> device, PidReports reports)
      : device_(std::move(device)), reports_(std::move(reports)) {}
  PidWheel(PidWheel&&) noexcept = default;
  PidWheel& operator=(PidWheel&&) = delete;
  /// Stops everything.
  ~PidWheel();

  /// −1 (right) to 1 (left); present conditions go on. Returns false if the device has no room for it.
  Expected<bool> set_force(double force);
  /// Share of the motor's force: for a spring at the end of its travel. Returns false if the device lacks it, or has no
  /// room.
  Expected<bool> set_condition(PidCondition kind, double share);

 private:
  using Block = std::int64_t;

  Expected<void> switch_on();
  /// A block of the device's memory with an effect of this kind in it; empty if it has no room.
  Expected<std::optional<Block>> create(HidUsage kind);
  Expected<void> start(Block block);
  Expected<void> control(HidUsage what);

  std::unique_ptr<HidDevice> device_;
  PidReports reports_;
  bool is_on_ = false;
  bool has_room_ = true;
  std::optional<Block> constant_;
  std::array<std::optional<Block>, 3> conditions_;
};

}  // namespace septet::car_io

#pragma once
/// Force feedback of wheels with USB's own class for it (Device Class Definition for Physical Interface Devices 1.0):
/// the reports of a device that create, change and start an effect, and the places of their values.
///
/// Pure functions over the device's descriptor (hid_fields.hpp).

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "car-io/pid/hid_fields.hpp"
#include "engine/core/bytes.hpp"

namespace septet::car_io {

/// Usages of page 0x0F (PID 1.0, 4).
namespace pid {
inline constexpr HidUsage page = 0x0Fu << 16;
inline constexpr HidUsage set_effect_report = page | 0x21, block_index = page | 0x22, parameter_offset = page | 0x23,
                          constant_force = page | 0x26, spring = page | 0x40, damper = page | 0x41,
                          friction = page | 0x43, duration = page | 0x50, gain = page | 0x52,
                          direction_enable = page | 0x56, direction = page | 0x57, set_condition_report = page | 0x5F,
                          centre_offset = page | 0x60, positive_coefficient = page | 0x61,
                          negative_coefficient = page | 0x62, positive_saturation = page | 0x63,
                          negative_saturation = page | 0x64, dead_band = page | 0x65, magnitude = page | 0x70,
                          set_constant_report = page | 0x73, operation_report = page | 0x77, start = page | 0x79,
                          loop_count = page | 0x7C, device_gain_report = page | 0x7D, device_gain = page | 0x7E,
                          block_load_report = page | 0x89, load_success = page | 0x8C, control_report = page | 0x95,
                          device_control = page | 0x96, enable_actuators = page | 0x97, stop_all = page | 0x99,
                          reset = page | 0x9A, create_report = page | 0xAB;
}  // namespace pid

/// One report and its values. A missing value is skipped; one beyond its logical range is clamped.
class PidReport {
 public:
  std::uint8_t id() const { return id_; }
  std::size_t bytes() const { return bytes_; }
  bool has(HidUsage usage) const { return find(usage) != nullptr; }

  Bytes empty() const;
  void set(Bytes& report, HidUsage usage, double value) const;
  /// 0 to 1 of the maximum, or −1 to 1 if the minimum is negative.
  void set_share(Bytes& report, HidUsage usage, double share) const;
  /// A share of the range from minimum to maximum: for a direction a share of a turn.
  void set_part(Bytes& report, HidUsage usage, double part) const;
  void set_seconds(Bytes& report, HidUsage usage, double seconds) const;
  /// One of a list, or a switch of its own. Returns false if the choice does not exist.
  bool choose(Bytes& report, HidUsage option) const;

  std::optional<std::int64_t> get(std::span<const std::byte> report, HidUsage usage) const;
  bool is_chosen(std::span<const std::byte> report, HidUsage option) const;

  /// The report whose fields lie in this collection; empty if there is none, or if it has no id.
  static std::optional<PidReport> of(const HidReportFields& device, HidReportKind kind, HidUsage collection);

 private:
  struct Value {
    HidUsage usage = 0;
    std::uint32_t first_bit = 0, bits = 0;
    std::int32_t least = 0, most = 0;
    int unit_exponent = 0;
    std::vector<HidUsage> options;  ///< For a list.
  };
  const Value* find(HidUsage usage) const;
  void put(Bytes& report, const Value& value, double number) const;

  std::uint8_t id_ = 0;
  std::size_t bytes_ = 0;
  std::vector<Value> values_;
};

struct PidReports {
  PidReport create, load, effect, constant, operation;
  std::optional<PidReport> condition, gain, control;
};
/// Empty if the device has no constant force of this class.
std::optional<PidReports> find_pid_reports(const HidReportFields& device);

}  // namespace septet::car_io

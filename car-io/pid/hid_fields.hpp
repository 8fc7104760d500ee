#pragma once
/// A HID device's report descriptor: values and their places in its reports (HID 1.11, 6.2.2).
///
/// Descriptors are untrusted. One that contradicts itself, ends within an item, or announces more than the bounds below
/// is refused with an Error; unknown pages are kept and ignored. Pure functions.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::car_io {

enum class HidReportKind : std::uint8_t { input, output, feature };

/// A usage as descriptors write it: its page in the upper sixteen bits.
using HidUsage = std::uint32_t;

/// `count` values of `bits` bits each, one after the other.
struct HidField {
  HidReportKind kind = HidReportKind::input;
  std::uint8_t report_id = 0;   ///< 0: the device's reports have no id.
  std::uint32_t first_bit = 0;  ///< From the report's beginning, its id included.
  std::uint32_t bits = 0, count = 0;
  std::int32_t least = 0, most = 0;  ///< Logical.
  int unit_exponent = 0;
  bool is_array = false;              ///< Each value selects one of `usages`; least is the first of them.
  std::vector<HidUsage> usages;       ///< For a variable field one per value, the last one for all following values.
  std::vector<HidUsage> collections;  ///< From the outermost on.
};

struct HidReportFields {
  std::vector<HidField> fields;
  std::array<std::array<std::uint32_t, 256>, 3> report_bits{};  ///< By kind and id, including padding.
  /// Bytes of a report, its id included; 0: no such report.
  std::size_t bytes_of(HidReportKind kind, std::uint8_t report_id) const;
};

inline constexpr std::size_t most_descriptor_bytes = 4096;  ///< Linux' HID_MAX_DESCRIPTOR_SIZE.
inline constexpr std::uint32_t most_report_bytes = 4096;

Expected<HidReportFields> read_hid_fields(std::span<const std::byte> descriptor);

}  // namespace septet::car_io

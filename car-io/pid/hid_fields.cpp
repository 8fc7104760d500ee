#include "car-io/pid/hid_fields.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace septet::car_io {
namespace {

constexpr std::size_t most_fields = 1024, most_usages = 1024, most_depth = 32;

/// Items' types and tags (HID 1.11, 6.2.2.4 to 6.2.2.8), the type in the lower two bits.
enum Item : unsigned {
  input = 0x8 << 2,
  output = 0x9 << 2,
  feature = 0xb << 2,
  collection = 0xa << 2,
  end_collection = 0xc << 2,
  usage_page = 0x0 << 2 | 1,
  logical_minimum = 0x1 << 2 | 1,
  logical_maximum = 0x2 << 2 | 1,
  unit_exponent = 0x5 << 2 | 1,
  report_size = 0x7 << 2 | 1,
  report_id = 0x8 << 2 | 1,
  report_count = 0x9 << 2 | 1,
  push = 0xa << 2 | 1,
  pop = 0xb << 2 | 1,
  usage = 0x0 << 2 | 2,
  usage_minimum = 0x1 << 2 | 2,
  usage_maximum = 0x2 << 2 | 2,
};

/// State that continues from item to item until it is set again.
struct Globals {
  std::uint32_t page = 0, bits = 0, count = 0;
  std::int32_t least = 0, most = 0;
  std::uint32_t most_unsigned = 0;
  int unit_exponent = 0;
  std::uint8_t report_id = 0;
};

std::int32_t as_signed(std::uint32_t value, std::size_t bytes) {
  if (bytes == 1) return static_cast<std::int8_t>(value);
  if (bytes == 2) return static_cast<std::int16_t>(value);
  return static_cast<std::int32_t>(value);
}

class Reader {
 public:
  Expected<HidReportFields> read(std::span<const std::byte> descriptor) {
    if (descriptor.size() > most_descriptor_bytes) return refused(0, "it is longer than 4096 bytes");
    for (std::size_t at = 0; at < descriptor.size();) {
      const auto prefix = std::to_integer<unsigned>(descriptor[at]);
      constexpr unsigned long_item = 0xfe;
      if (prefix == long_item) return refused(at, "it has a long item, of which there are none");
      const std::size_t bytes = (prefix & 3u) == 3u ? 4 : prefix & 3u;
      if (descriptor.size() - at - 1 < bytes) return refused(at, "it ends in the midst of an item");
      std::uint32_t value = 0;
      for (std::size_t i = 0; i < bytes; ++i)
        value |= std::to_integer<std::uint32_t>(descriptor[at + 1 + i]) << (8 * i);
      if (const auto taken = take(prefix >> 2, value, bytes); !taken.empty()) return refused(at, taken);
      at += 1 + bytes;
    }
    if (!collections_.empty()) return refused(descriptor.size(), "a collection does not end");
    return std::move(result_);
  }

 private:
  static tl::unexpected<Error> refused(std::size_t at, const std::string& what) {
    return failure(what, fmt::format("HID report descriptor, byte {}", at), "correct the device's firmware");
  }

  /// The fault, or empty.
  std::string take(unsigned item, std::uint32_t value, std::size_t bytes) {
    switch (item) {
      case input:
        return add(HidReportKind::input, value);
      case output:
        return add(HidReportKind::output, value);
      case feature:
        return add(HidReportKind::feature, value);
      case collection:
        if (collections_.size() >= most_depth) return "its collections lie too deep in each other";
        collections_.push_back(usages_.empty() ? 0 : full(usages_.front()));
        forget_usages();
        return {};
      case end_collection:
        if (collections_.empty()) return "a collection ends that has not begun";
        collections_.pop_back();
        forget_usages();
        return {};
      case usage_page:
        now_.page = value & 0xFFFFu;
        return {};
      case logical_minimum:
        now_.least = as_signed(value, bytes);
        return {};
      case logical_maximum:
        now_.most = as_signed(value, bytes);
        now_.most_unsigned = value;
        return {};
      case unit_exponent:
        // Four bits with a sign.
        now_.unit_exponent = static_cast<int>(value & 0xFu) - ((value & 0x8u) != 0 ? 16 : 0);
        return {};
      case report_size:
        now_.bits = value;
        return {};
      case report_id:
        if (value == 0 || value > 255) return "a report's id is not from 1 to 255";
        now_.report_id = static_cast<std::uint8_t>(value);
        return {};
      case report_count:
        now_.count = value;
        return {};
      case push:
        if (kept_.size() >= most_depth) return "it keeps too much for later";
        kept_.push_back(now_);
        return {};
      case pop:
        if (kept_.empty()) return "it takes back what it has not kept";
        now_ = kept_.back();
        kept_.pop_back();
        return {};
      case usage:
        return add_usage({value, bytes == 4});
      case usage_minimum:
        first_usage_ = value;
        return {};
      case usage_maximum: {
        if (value < first_usage_ || value - first_usage_ >= most_usages) return "a range of usages has no end";
        for (std::uint32_t i = 0; i <= value - first_usage_; ++i)
          if (auto wrong = add_usage({first_usage_ + i, bytes == 4}); !wrong.empty()) return wrong;
        return {};
      }
      default:
        return {};  // Physical ends, units, designators, strings.
    }
  }

  /// A usage of two bytes is of the page that holds when the field or collection comes.
  struct Written {
    std::uint32_t value;
    bool has_page;
  };
  HidUsage full(const Written& usage) const { return usage.has_page ? usage.value : now_.page << 16 | usage.value; }

  std::string add_usage(const Written& each) {
    if (usages_.size() >= most_usages) return "it has too many usages";
    usages_.push_back(each);
    return {};
  }
  void forget_usages() {
    usages_.clear();
    first_usage_ = 0;
  }

  std::string add(HidReportKind kind, std::uint32_t flags) {
    constexpr std::uint32_t most_bits = 8 * most_report_bytes, constant = 1, variable = 2;
    if (now_.bits > 32 && (flags & constant) == 0) return "a value has more than 32 bits";
    if (now_.bits > most_bits || now_.count > most_bits) return "a report is longer than 4096 bytes";
    std::uint32_t& used = result_.report_bits[static_cast<std::size_t>(kind)][now_.report_id];
    if (used == 0 && now_.report_id != 0) used = 8;
    const std::uint64_t end = used + std::uint64_t{now_.bits} * now_.count;
    if (end > most_bits) return "a report is longer than 4096 bytes";
    if (result_.fields.size() >= most_fields) return "it has too many fields";
    // With a minimum that is not negative, a maximum of all ones is unsigned.
    const std::int32_t most = now_.least >= 0 && now_.most < 0
                                  ? static_cast<std::int32_t>(std::min(now_.most_unsigned, 0x7FFFFFFFu))
                                  : now_.most;
    std::vector<HidUsage> usages;
    for (const Written& each : usages_) usages.push_back(full(each));
    if ((flags & constant) == 0 && now_.bits > 0 && now_.count > 0)
      result_.fields.push_back({.kind = kind,
                                .report_id = now_.report_id,
                                .first_bit = used,
                                .bits = now_.bits,
                                .count = now_.count,
                                .least = now_.least,
                                .most = most,
                                .unit_exponent = now_.unit_exponent,
                                .is_array = (flags & variable) == 0,
                                .usages = std::move(usages),
                                .collections = collections_});
    used = static_cast<std::uint32_t>(end);
    forget_usages();
    return {};
  }

  Globals now_;
  std::vector<Globals> kept_;
  std::vector<Written> usages_;
  std::vector<HidUsage> collections_;
  std::uint32_t first_usage_ = 0;
  HidReportFields result_;
};

}  // namespace

std::size_t HidReportFields::bytes_of(HidReportKind kind, std::uint8_t report_id) const {
  return (report_bits[static_cast<std::size_t>(kind)][report_id] + 7) / 8;
}

Expected<HidReportFields> read_hid_fields(std::span<const std::byte> descriptor) { return Reader().read(descriptor); }

}  // namespace septet::car_io

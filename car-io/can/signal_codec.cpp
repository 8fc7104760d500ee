#include "car-io/can/signal_codec.hpp"

#include <algorithm>
#include <bit>
#include <bitset>
#include <cmath>
#include <limits>
#include <utility>

namespace septet::car_io::dbc {
namespace {

/// Calls `at(bit of the frame, bit of the raw value)` for each bit of the signal.
template <class At>
void each_bit(const Signal& signal, At at) {
  unsigned place = signal.start_bit;
  for (unsigned i = 0; i < signal.bits; ++i)
    if (signal.order == ByteOrder::intel) {
      at(place + i, i);
    } else {
      at(place, signal.bits - 1u - i);
      place = place % 8 == 0 ? place + 15 : place - 1;
    }
}

unsigned bytes_of(const Signal& signal) {
  unsigned last = 0;
  each_bit(signal, [&](unsigned place, unsigned) { last = std::max(last, place); });
  return last / 8 + 1;
}

std::uint64_t raw_of(const Signal& signal, std::span<const std::byte> data) {
  std::uint64_t raw = 0;
  each_bit(signal, [&](unsigned place, unsigned bit) {
    raw |= static_cast<std::uint64_t>(std::to_integer<unsigned>(data[place / 8]) >> place % 8 & 1u) << bit;
  });
  return raw;
}

double number_of(const Signal& signal, std::uint64_t raw) {
  switch (signal.number) {
    case Number::unsigned_whole:
      return static_cast<double>(raw);
    case Number::signed_whole: {
      const int unused = 64 - signal.bits;
      return static_cast<double>(std::bit_cast<std::int64_t>(raw << unused) >> unused);
    }
    case Number::float32:
      return std::bit_cast<float>(static_cast<std::uint32_t>(raw));
    case Number::float64:
      return std::bit_cast<double>(raw);
  }
  return 0.0;
}

/// From any number.
std::uint64_t raw_of(const Signal& signal, double number) {
  if (signal.number == Number::float64) return std::bit_cast<std::uint64_t>(number);
  if (signal.number == Number::float32) {
    constexpr double most = std::numeric_limits<float>::max();
    return std::bit_cast<std::uint32_t>(static_cast<float>(std::clamp(number, -most, most)));
  }
  const double whole = std::nearbyint(number);
  // 2^bits as a double is exact; its neighbour below may be too coarse, so the ends are compared and not clamped to.
  if (signal.number == Number::unsigned_whole) {
    const std::uint64_t most = ~0ull >> (64 - signal.bits);
    if (whole >= std::ldexp(1.0, signal.bits)) return most;
    return whole <= 0.0 ? 0 : static_cast<std::uint64_t>(whole);
  }
  const auto most = static_cast<std::int64_t>((std::uint64_t{1} << (signal.bits - 1)) - 1);
  const std::int64_t least = -most - 1;
  const double end = std::ldexp(1.0, signal.bits - 1);
  if (whole >= end) return std::bit_cast<std::uint64_t>(most);
  return std::bit_cast<std::uint64_t>(whole < -end ? least : static_cast<std::int64_t>(whole));
}

std::bitset<512> bits_of(const Signal& signal) {
  std::bitset<512> bits;
  each_bit(signal, [&](unsigned place, unsigned) { bits.set(place); });
  return bits;
}

}  // namespace

std::optional<double> decode(const Message& message, const Signal& signal, std::span<const std::byte> data) {
  if (data.size() < bytes_of(signal)) return std::nullopt;
  if (signal.selected_by) {
    const auto selecting = std::ranges::find(message.signals, true, &Signal::selects);
    if (selecting == message.signals.end() || data.size() < bytes_of(*selecting) ||
        raw_of(*selecting, data) != *signal.selected_by)
      return std::nullopt;
  }
  return number_of(signal, raw_of(signal, data)) * signal.scale + signal.offset;
}

void encode(const Signal& signal, double physical, std::span<std::byte> data) {
  if (data.size() < bytes_of(signal)) return;
  if (std::isnan(physical)) physical = 0.0;
  if (signal.low < signal.high) physical = std::clamp(physical, signal.low, signal.high);
  const std::uint64_t raw = raw_of(signal, (physical - signal.offset) / signal.scale);
  each_bit(signal, [&](unsigned place, unsigned bit) {
    const std::byte mask{static_cast<unsigned char>(1u << place % 8)};
    data[place / 8] = (raw >> bit & 1u) != 0 ? data[place / 8] | mask : data[place / 8] & ~mask;
  });
}

std::optional<std::pair<const Signal*, const Signal*>> overlap(const Message& message) {
  for (std::size_t i = 0; i < message.signals.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Signal &a = message.signals[j], &b = message.signals[i];
      const bool never_together = a.selected_by && b.selected_by && *a.selected_by != *b.selected_by;
      if (!never_together && (bits_of(a) & bits_of(b)).any()) return std::pair(&a, &b);
    }
  return std::nullopt;
}

}  // namespace septet::car_io::dbc

#pragma once
/// FNV-1a, 64 bits: the hash of simulation state. It tells two runs apart; it does not protect against forgery.

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace septet {

class StateHash {
 public:
  void add_bytes(std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) add_byte(static_cast<std::uint8_t>(byte));
  }
  /// Integers are hashed as eight little-endian bytes, so that the value decides and not the type.
  void add(std::integral auto value) {
    auto bits = static_cast<std::uint64_t>(value);
    for (int i = 0; i < 8; ++i, bits >>= 8) add_byte(static_cast<std::uint8_t>(bits));
  }
  /// The exact bits: −0.0 and +0.0 differ.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }

  std::uint64_t value() const { return value_; }

 private:
  void add_byte(std::uint8_t byte) { value_ = (value_ ^ byte) * 0x100000001b3u; }
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace septet

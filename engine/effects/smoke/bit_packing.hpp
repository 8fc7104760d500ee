#pragma once
/// Numbers of a few bits each, packed least significant first into bytes.

#include "engine/core/bytes.hpp"

namespace septet::smoke {

class BitWriter {
 public:
  explicit BitWriter(Bytes& out) : out_(out) {}
  ~BitWriter() {
    if (held_ > 0) out_.push_back(static_cast<std::byte>(bits_ & 0xff));
  }
  BitWriter(const BitWriter&) = delete;
  BitWriter& operator=(const BitWriter&) = delete;

  /// Appends the low `count` bits of `value`, whose other bits are zero; count at most 32.
  void put(std::uint32_t value, int count) {
    bits_ |= static_cast<std::uint64_t>(value) << held_;
    for (held_ += count; held_ >= 8; held_ -= 8, bits_ >>= 8) out_.push_back(static_cast<std::byte>(bits_ & 0xff));
  }

 private:
  Bytes& out_;
  std::uint64_t bits_ = 0;
  int held_ = 0;
};

class BitReader {
 public:
  explicit BitReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  /// Zero past the end; the caller has bounded the count of bits beforehand.
  std::uint32_t get(int count) {
    for (; held_ < count; held_ += 8)
      bits_ |= static_cast<std::uint64_t>(at_ < bytes_.size() ? bytes_[at_++] : std::byte{}) << held_;
    const auto value = static_cast<std::uint32_t>(bits_ & ((std::uint64_t{1} << count) - 1));
    bits_ >>= count;
    held_ -= count;
    return value;
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  std::uint64_t bits_ = 0;
  int held_ = 0;
};

}  // namespace septet::smoke

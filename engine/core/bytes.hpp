#pragma once
/// Bounded little-endian reading and writing of bytes: the base of every wire and file format of Septet.
///
/// The writer trusts the program; the reader trusts nothing. Reading past the end, or a value out of bounds, puts the
/// reader into its failed state, in which every further read returns zero, so that a decoder checks `ok()` once per
/// record and never indexes with a value it has not bounded.

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace septet {

using Bytes = std::vector<std::byte>;

/// Writes a varint at `at`, where there must be room for ten bytes, and returns its end: seven bits a byte, least
/// significant first.
inline std::byte* write_varint(std::byte* at, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) *at++ = static_cast<std::byte>(value | 0x80);
  *at++ = static_cast<std::byte>(value);
  return at;
}
/// Maps small magnitudes of either sign to small numbers: 0, −1, 1, −2, …
constexpr std::uint64_t zigzag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}

class ByteWriter {
 public:
  explicit ByteWriter(Bytes& out) : out_(out) {}

  template <std::integral T>
  void put(T value) {
    using Unsigned = std::make_unsigned_t<T>;
    auto bits = static_cast<Unsigned>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i)
      out_.push_back(static_cast<std::byte>((static_cast<std::uint64_t>(bits) >> (8 * i)) & 0xff));
  }
  void put(float value) { put(std::bit_cast<std::uint32_t>(value)); }
  void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
  void put_varint(std::uint64_t value) {
    std::byte bytes[10];
    put_bytes({bytes, write_varint(bytes, value)});
  }
  /// Signed varint: small magnitudes of either sign are short.
  void put_signed_varint(std::int64_t value) { put_varint(zigzag(value)); }
  void put_bytes(std::span<const std::byte> bytes) { out_.insert(out_.end(), bytes.begin(), bytes.end()); }
  /// Length as varint, then the bytes.
  void put_string(std::string_view text) {
    put_varint(text.size());
    put_bytes(std::as_bytes(std::span(text)));
  }

 private:
  Bytes& out_;
};

class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }
  bool at_end() const { return position_ == bytes_.size(); }
  std::size_t remaining() const { return bytes_.size() - position_; }
  void fail() { ok_ = false; }

  template <std::integral T>
  T get() {
    std::uint64_t bits = 0;
    const auto bytes = take(sizeof(T));
    for (std::size_t i = 0; i < bytes.size(); ++i) bits |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
    return static_cast<T>(bits);
  }
  float get_float() { return std::bit_cast<float>(get<std::uint32_t>()); }
  double get_double() { return std::bit_cast<double>(get<std::uint64_t>()); }
  std::uint64_t get_varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = get<std::uint8_t>();
      if (!ok_) return 0;
      if (shift == 63 && byte > 1) break;
      value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    fail();
    return 0;
  }
  std::int64_t get_signed_varint() {
    const std::uint64_t bits = get_varint();
    return static_cast<std::int64_t>((bits >> 1) ^ (0 - (bits & 1)));
  }
  /// A count that must not exceed `limit`; anything larger fails the reader and returns zero.
  std::size_t get_count(std::size_t limit) {
    const std::uint64_t count = get_varint();
    if (count > limit) {
      fail();
      return 0;
    }
    return static_cast<std::size_t>(count);
  }
  /// The next `count` bytes, or an empty span and the failed state.
  std::span<const std::byte> take(std::size_t count) {
    if (!ok_ || count > remaining()) {
      fail();
      return {};
    }
    const auto result = bytes_.subspan(position_, count);
    position_ += count;
    return result;
  }
  std::string get_string(std::size_t limit) {
    const auto bytes = take(get_count(limit));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace septet

#pragma once
/// The hash of simulation state, 64 bits: it tells two runs apart; it does not protect against forgery.
///
/// FNV-1a, but a word of 64 bits at a time, with the high half folded into the low one after each product, so that
/// every bit of a word reaches every bit of the hash within two words. Each step is a bijection of the hash for a given
/// word and of the word for a given hash: two states that differ in one word never hash alike. Bytes are padded to
/// words with zeros and their number is hashed too. The same on every machine.

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace septet {

class StateHash {
 public:
  void add_bytes(std::span<const std::byte> bytes) {
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      word |= static_cast<std::uint64_t>(bytes[i]) << (8 * (i % 8));
      if (i % 8 == 7) add_word(std::exchange(word, 0));
    }
    if (bytes.size() % 8 != 0) add_word(word);
    add_word(bytes.size());
  }
  /// An integer of any type as its 64 bits: the value decides and not the type.
  void add(std::integral auto value) { add_word(static_cast<std::uint64_t>(value)); }
  /// The exact bits: −0.0 and +0.0 differ.
  void add(double value) { add_word(std::bit_cast<std::uint64_t>(value)); }

  std::uint64_t value() const { return value_; }

 private:
  void add_word(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x9e3779b97f4a7c15u;  // An odd constant: 2^64 over the golden ratio.
    value_ ^= value_ >> 32;
  }
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace septet

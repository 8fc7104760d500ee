#pragma once
/// Record of the packet numbers received from the other end: rejects repetitions and supplies acknowledgements.

#include <array>
#include <cstdint>
#include <optional>

namespace septet::net {

/// Packet numbers received, as ranges from the newest downwards; both ends inclusive.
struct PacketRanges {
  struct Range {
    std::uint64_t last = 0, first = 0;
  };
  static constexpr std::size_t limit = 32;
  std::array<Range, limit> ranges{};
  std::size_t count = 0;
};

class ReceivedPackets {
 public:
  static constexpr std::uint64_t window = 8192;

  /// True for a number not seen before and not older than the window.
  bool is_new(std::uint64_t number) const;
  /// Records an authenticated packet; call it only after authentication.
  void add(std::uint64_t number);
  /// The newest ranges, as many as an acknowledgement holds. Needs at least one packet.
  PacketRanges ranges() const;

 private:
  bool has(std::uint64_t number) const { return words_[number / 64 % words] >> (number % 64) & 1; }

  static constexpr std::size_t words = window / 64;
  std::array<std::uint64_t, words> words_{};
  std::optional<std::uint64_t> newest_;
};

}  // namespace septet::net

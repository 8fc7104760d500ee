#include "engine/net/received_packets.hpp"

#include "engine/core/check.hpp"

namespace septet::net {

bool ReceivedPackets::is_new(std::uint64_t number) const {
  if (!newest_ || number > *newest_) return true;
  return *newest_ - number < window && !has(number);
}

void ReceivedPackets::add(std::uint64_t number) {
  if (!newest_) {
    newest_ = number;
  } else if (number > *newest_) {
    if (number - *newest_ >= window) {
      words_.fill(0);
    } else {
      for (std::uint64_t skipped = *newest_ + 1; skipped <= number; ++skipped)
        words_[skipped / 64 % words] &= ~(1ull << (skipped % 64));
    }
    newest_ = number;
  }
  words_[number / 64 % words] |= 1ull << (number % 64);
}

PacketRanges ReceivedPackets::ranges() const {
  SEPTET_CHECK(newest_.has_value(), "nothing received");
  PacketRanges result;
  // The oldest number whose bit is still its own; one word less, because the newest word's upper bits are stale.
  const std::uint64_t kept = window - 64;
  const std::uint64_t oldest = *newest_ >= kept ? *newest_ - kept + 1 : 0;
  std::uint64_t number = *newest_;
  while (true) {
    PacketRanges::Range range{number, number};
    while (range.first > oldest && has(range.first - 1)) {
      // Whole words of ones at once.
      const bool whole =
          range.first % 64 == 0 && range.first >= oldest + 64 && words_[(range.first - 1) / 64 % words] == ~0ull;
      range.first -= whole ? 64 : 1;
    }
    result.ranges[result.count++] = range;
    if (result.count == PacketRanges::limit || range.first <= oldest) return result;
    number = range.first - 1;
    while (number > oldest && !has(number)) --number;
    if (!has(number)) return result;
  }
}

}  // namespace septet::net

#pragma once
/// The receiving half of a reliable lane: reassembles fragments and delivers messages in order, within bounds.

#include <cstdint>
#include <map>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/net/scene_frames.hpp"

namespace septet::net {

class ReliableReceiver {
 public:
  ReliableReceiver(std::size_t max_message_bytes, std::size_t window_bytes)
      : max_message_bytes_(max_message_bytes), window_bytes_(window_bytes) {}

  /// Takes a fragment and appends the messages that it completes, in order. False: the other end broke
  /// the protocol (overlap, contradiction, beyond the bounds), and no more frames should be taken from it.
  bool accept(const Frame& frame, std::vector<Bytes>& completed);
  /// Sum of the sizes of messages begun and not yet delivered.
  std::size_t bytes_held() const { return bytes_held_; }

 private:
  struct Incoming {
    Bytes bytes;
    std::size_t missing = 0;
    std::map<std::size_t, std::size_t> runs;  ///< Received ranges: begin to end.
  };
  bool add(Incoming& incoming, std::size_t offset, std::span<const std::byte> bytes);

  std::size_t max_message_bytes_, window_bytes_;
  std::map<std::uint64_t, Incoming> incoming_;
  std::uint64_t next_ = 0;
  std::size_t bytes_held_ = 0;
};

}  // namespace septet::net

#pragma once
/// Plaintext of a data datagram of the scene lane: a run of frames (PROTOCOL.md, "Data").

#include <cstdint>
#include <span>

#include "engine/core/bytes.hpp"
#include "engine/net/received_packets.hpp"

namespace septet::net {

enum class FrameKind : std::uint8_t {
  acknowledge = 1,
  fragment = 2,
  unreliable = 4,
  ping = 5,
  pong = 6,
  goodbye = 7,
};

/// One frame; its kind decides which fields count.
struct Frame {
  FrameKind kind = FrameKind::ping;
  PacketRanges received{};             ///< acknowledge
  std::uint64_t message = 0;           ///< fragment
  std::uint64_t message_bytes = 0;     ///< fragment
  std::uint64_t offset = 0;            ///< fragment
  std::span<const std::byte> bytes{};  ///< fragment, unreliable, goodbye
  double sent_s = 0.0;                 ///< ping, pong
  double answered_s = 0.0;             ///< pong
};

/// The next frame; false at the end or when the reader has failed. Makes the checks that need no state, so offset +
/// length never exceeds message_bytes and ranges descend.
bool read_frame(ByteReader& reader, Frame& out);
void write_frame(const Frame& frame, ByteWriter& writer);

/// Least weight of a fragment, beside its bytes, in the sender's and the receiver's window: bounds empty messages too.
inline constexpr std::size_t fragment_weight = 32;

std::size_t varint_bytes(std::uint64_t value);
/// Length of a fragment frame without its bytes.
std::size_t fragment_overhead(std::uint64_t message, std::uint64_t message_bytes, std::uint64_t offset,
                              std::size_t length);
inline constexpr std::size_t max_goodbye_bytes = 200;

}  // namespace septet::net

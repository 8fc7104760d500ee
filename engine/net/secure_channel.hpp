#pragma once
/// Definitions shared by both ends of the scene lane: kinds of messages, limits and counters (PROTOCOL.md, "Scene
/// lane").

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "engine/core/bytes.hpp"
#include "engine/net/keys.hpp"

namespace septet::net {

enum class Reliability : std::uint8_t {
  reliable,    ///< Delivered once, in order, up to the message limit; resent until acknowledged.
  unreliable,  ///< At most one datagram; may be lost, repeated messages are not delivered twice.
};

/// A message that several clients share without copies.
using SharedBytes = std::shared_ptr<const Bytes>;
inline SharedBytes share(Bytes bytes) { return std::make_shared<const Bytes>(std::move(bytes)); }

enum class SendResult : std::uint8_t {
  queued,
  not_connected,
  too_large,   ///< Longer than the message limit, or, if unreliable, than one datagram.
  queue_full,  ///< A server drops such a client; a client may try again later.
};

struct ChannelLimits {
  /// UDP payload; the smaller of the two ends' values counts. 0: 1,200, and 16,384 over loopback.
  std::size_t max_datagram_bytes = 0;
  std::size_t max_message_bytes = 64u << 20;  ///< Bound on one reliable message, both ways.
  std::size_t max_queue_bytes = 256u << 20;   ///< Bytes waiting to be sent or acknowledged, per connection.
  std::size_t window_bytes = 8u << 20;        ///< Bytes that an end accepts out of order.
  /// Bytes sent in one pump over all connections, so that a tick is not delayed.
  std::size_t max_bytes_per_pump = 1u << 20;
  double timeout_s = 2.0;  ///< Silence after which the other end counts as lost.
};

struct ChannelCounters {
  std::uint64_t datagrams_sent = 0, bytes_sent = 0;
  std::uint64_t datagrams_received = 0, bytes_received = 0;
  std::uint64_t resent = 0;       ///< Fragments sent again.
  std::uint64_t forged = 0;       ///< Authentication failed.
  std::uint64_t replayed = 0;     ///< Packet number seen before or too old.
  std::uint64_t malformed = 0;    ///< Not a datagram of this protocol, or broken inside.
  std::uint64_t unknown = 0;      ///< Datagrams for no current connection (an earlier one, usually).
  std::uint64_t not_allowed = 0;  ///< Handshakes with a key that is not on the list.
  std::uint64_t bad_cookies = 0;  ///< Handshakes from an address that did not prove itself (or too late).

  ChannelCounters& operator+=(const ChannelCounters& other);
};

}  // namespace septet::net

#pragma once
/// Interface between Septet's protocols and the network: a socket that sends and receives datagrams without blocking.
///
/// `UdpSocket` is the real one; `BadNetwork` makes simulated ones with loss, jitter, reordering and duplication. A
/// datagram may be lost, repeated or reordered by either without any report here.

#include <cstddef>
#include <optional>
#include <span>

#include "engine/net/address.hpp"

namespace septet::net {

struct ReceivedDatagram {
  Address from;
  std::span<const std::byte> bytes;  ///< Valid until the next call on the same socket.
  /// Arrival by the machine's steady clock, before any wait in the socket's buffer. Empty: unknown.
  std::optional<double> arrived_s{};
};

class DatagramSocket {
 public:
  virtual ~DatagramSocket() = default;

  /// Queues one datagram; `flush` puts the queue on the wire. False: the system accepts no more now, the datagram was
  /// not queued, and the caller tries again later (or drops it, where newest wins).
  virtual bool send(const Address& to, std::span<const std::byte> bytes) = 0;
  virtual void flush() = 0;
  /// The next datagram that has arrived, if any.
  virtual std::optional<ReceivedDatagram> receive() = 0;
  /// Size of the system's buffer for datagrams not yet received; the scene lane's window is derived from it.
  virtual std::size_t receive_buffer_bytes() const = 0;
};

}  // namespace septet::net

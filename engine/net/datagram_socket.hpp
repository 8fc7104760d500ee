#pragma once
/// The seam between Septet's protocols and the network: something that sends and receives datagrams
/// without blocking.
///
/// `UdpSocket` is the real one; `BadNetwork` hands out simulated ones with loss, jitter, reordering
/// and duplication. A datagram may be lost, repeated or reordered by either; nothing here reports
/// that.

#include <cstddef>
#include <optional>
#include <span>

#include "engine/net/address.hpp"

namespace septet::net {

struct ReceivedDatagram {
  Address from;
  std::span<const std::byte> bytes;  ///< Valid until the next call on the same socket.
  /// When it arrived, by the machine's steady clock, however long it has waited since. Nothing: not known.
  std::optional<double> arrived_s{};
};

class DatagramSocket {
 public:
  virtual ~DatagramSocket() = default;

  /// Queues one datagram; `flush` puts the queue on the wire. False: the system takes no more now,
  /// nothing was queued, and the caller tries again later (or, where newest wins, forgets it).
  virtual bool send(const Address& to, std::span<const std::byte> bytes) = 0;
  virtual void flush() = 0;
  /// The next datagram that has arrived, or nothing.
  virtual std::optional<ReceivedDatagram> receive() = 0;
  /// Bytes that the system keeps for datagrams not yet received; the scene lane's window is derived
  /// from it.
  virtual std::size_t receive_buffer_bytes() const = 0;
};

}  // namespace septet::net

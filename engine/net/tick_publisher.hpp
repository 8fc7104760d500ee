#pragma once
/// The sending end of the tick lane (PROTOCOL.md, "Tick lane"): a tick's bytes become signed datagrams, each sent once
/// to the group and once to every unicast destination, followed by those of the tick before.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/net/datagram_socket.hpp"
#include "engine/net/keys.hpp"

namespace septet::net {

/// Bounds on the payload of a tick, and on its datagrams (UDP payload).
inline constexpr std::size_t max_tick_bytes = 256 * 1024;
inline constexpr std::size_t default_max_datagram_bytes = 1200;
inline constexpr std::size_t smallest_max_datagram_bytes = 576;
inline constexpr std::size_t largest_max_datagram_bytes = 65507;

struct TickPublisherOptions {
  std::size_t max_datagram_bytes = default_max_datagram_bytes;
  bool repeat_previous = true;
};

struct TickPublisherCounters {
  std::uint64_t ticks = 0;
  std::uint64_t datagrams = 0;  ///< Datagrams handed to the socket, counting each destination.
  std::uint64_t bytes = 0;      ///< Bytes of those datagrams.
  std::uint64_t refused = 0;    ///< Datagrams that the socket did not accept.
};

class TickPublisher {
 public:
  /// The socket must outlive the publisher.
  TickPublisher(DatagramSocket& socket, const Identity& server, const SessionId& session,
                const TickPublisherOptions& options = {});
  /// Numbers its publications together with another publisher of the session, to other destinations: no datagram of one
  /// can stand for one of the other's.
  TickPublisher(DatagramSocket& socket, const Identity& server, const SessionId& session,
                const TickPublisherOptions& options, const TickPublisher& numbered_with);

  /// Adds a group, or a client's unicast address; a repeated one changes nothing.
  void add_destination(const Address& destination);
  void remove_destination(const Address& destination);
  const std::vector<Address>& destinations() const { return destinations_; }

  /// Signs and sends. `tick` must grow from call to call, by any step; `payload` holds at most max_tick_bytes.
  void publish(std::uint64_t tick, std::span<const std::byte> payload);
  /// Sends the newest tick's datagrams again, as repetitions: for a server in lockstep that lacks acknowledgements.
  void repeat_newest();

  const TickPublisherCounters& counters() const { return counters_; }

 private:
  void send(std::vector<Bytes>& datagrams, bool repetition);

  DatagramSocket& socket_;
  Identity server_;
  SessionId session_;
  TickPublisherOptions options_;
  std::vector<Address> destinations_;
  std::shared_ptr<std::uint64_t> sequence_ = std::make_shared<std::uint64_t>(0);
  std::optional<std::uint64_t> newest_tick_;
  std::vector<Bytes> newest_, previous_;  ///< Datagrams of the last two ticks.
  TickPublisherCounters counters_;
};

}  // namespace septet::net

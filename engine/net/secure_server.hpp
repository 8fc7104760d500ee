#pragma once
/// The server's end of the scene lane: authenticated, encrypted connections to the clients on its list.
///
///     for (const ServerEvent& event : server.pump(now_s)) …
///     server.send(client, share(bytes), Reliability::reliable, key);
///
/// One thread; `now_s` never goes back. A client that hangs or vanishes is dropped after the time-out, or as soon as
/// its queue is full, and costs at most that queue. Several pumps per tick make transfers faster.
///
/// One key is one client: while it is live, another one with its key is refused. A restarted client is accepted once
/// the old one has been silent for twice its usual silence, at least half a second, at most 5 s and 5 s where that is
/// not yet known; or at once from its old address.

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "engine/net/datagram_socket.hpp"
#include "engine/net/secure_channel.hpp"

namespace septet::net {

/// One connection; a client that reconnects gets another number. Never 0.
using ClientId = std::uint32_t;

struct SecureServerOptions {
  Identity identity;
  SessionId session{};  ///< The tick lane's; sent to every client.
  std::vector<AllowedClient> allowed;
  ChannelLimits limits;
};

struct ServerEvent {
  enum class Kind : std::uint8_t {
    connected,
    message,
    disconnected,
    refused,  ///< A key that is not on the list, or is used twice: `reason` names it, for the operator; at most one
              ///< event a second.
  };
  Kind kind = Kind::message;
  ClientId client = 0;
  Reliability reliability = Reliability::reliable;
  Bytes bytes{};         ///< Content of a message.
  std::string name{};    ///< Name of the connected client in the list. It may be gone when the event is read, so `info`
                         ///< may not know it.
  std::string reason{};  ///< Reason of a disconnection or refusal, for the log.
};

struct ClientInfo {
  PublicKey key{};
  std::string name;
  Address address;
  double heard_s = 0.0;  ///< Arrival of its last datagram.
  double round_trip_s = 0.0;
  std::size_t queued_bytes = 0;
  ChannelCounters counters;
};

class SecureServer {
 public:
  /// The socket must outlive the server.
  SecureServer(DatagramSocket& socket, SecureServerOptions options);
  ~SecureServer();

  /// Receives, acknowledges, resends and sends; returns the events since the last pump, in order.
  std::vector<ServerEvent> pump(double now_s);
  /// True if more is waiting to be sent than the last pump was allowed to: pump again soon.
  bool has_backlog() const;

  SendResult send(ClientId client, SharedBytes message, Reliability reliability);
  SendResult send(ClientId client, std::span<const std::byte> message, Reliability reliability);
  /// Says goodbye; the event `disconnected` comes with the next pump.
  void disconnect(ClientId client, std::string reason);

  /// Replaces the list for new connections; connected clients that are no longer on it, or stand under another name,
  /// are dropped.
  void set_allowed(std::vector<AllowedClient> allowed);

  std::vector<ClientId> clients() const;
  /// Null for a client that is not connected. Valid until the next call.
  const ClientInfo* info(ClientId client) const;
  /// Sum over all connections, past ones and unknown senders included.
  ChannelCounters counters() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace septet::net

#pragma once
/// A client's end of the scene lane. It connects by itself, and again by itself when the server was
/// lost or restarted.
///
/// One thread; `now_s` never goes back.

#include <memory>
#include <span>
#include <vector>

#include "engine/net/clock_estimate.hpp"
#include "engine/net/datagram_socket.hpp"
#include "engine/net/secure_channel.hpp"

namespace septet::net {

struct SecureClientOptions {
  Address server;
  PublicKey server_key{};  ///< Pinned: nobody else can be the server.
  Identity identity;
  ChannelLimits limits;
  /// Silence after which it looks for another server in the old one's place, without giving the old one up yet.
  double knock_after_s = 1.0;
};

struct ClientEvent {
  enum class Kind : std::uint8_t { connected, message, lost };
  Kind kind = Kind::message;
  Reliability reliability = Reliability::reliable;
  Bytes bytes{};         ///< Of a message.
  std::string reason{};  ///< Of a loss, for the log.
};

enum class ClientState : std::uint8_t {
  connecting,  ///< Never connected yet, trying.
  connected,
  lost,  ///< Was connected, trying again.
};

/// What keeps a client from its server, as far as it can know.
enum class Obstacle : std::uint8_t {
  none,              ///< It is connected, or has not tried for long.
  no_answer,         ///< Nobody answers at the server's address.
  other_server_key,  ///< A server answers there that cannot read what is sealed for the pinned key.
  other_version,     ///< What answers there speaks another version of the protocol.
  key_unknown,       ///< The server does not have this client's key on its list.
  key_in_use,        ///< Another client with this key is connected.
};

class SecureClient {
 public:
  /// The socket must outlive the client.
  SecureClient(DatagramSocket& socket, SecureClientOptions options);
  ~SecureClient();

  std::vector<ClientEvent> pump(double now_s);
  bool has_backlog() const;

  SendResult send(SharedBytes message, Reliability reliability, AddressKey key = no_address_key);
  SendResult send(std::span<const std::byte> message, Reliability reliability, AddressKey key = no_address_key);
  /// Says goodbye and stays silent from then on.
  void close();

  /// Says goodbye and tries again after a while.
  void leave_for(double seconds);

  ClientState state() const;
  Obstacle obstacle() const;
  /// Why the last connection ended; empty before that.
  const std::string& loss() const;
  /// For how long the server has owed an answer on this connection; 0 without one. Time in which nobody pumped does not
  /// count: whoever draws for seconds has not asked.
  double silence_s() const;
  /// Of the running connection; what the tick lane is to follow.
  const SessionId& session() const;
  /// Of the server's `now_s` from pings on this connection; not valid before the first answer.
  const ClockEstimate& clock() const;
  double round_trip_s() const;
  const ChannelCounters& counters() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace septet::net

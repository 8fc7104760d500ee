#pragma once
/// A client's end of the scene lane. It connects by itself, and reconnects when the server was lost or restarted.
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
  PublicKey server_key{};  ///< Pinned: no other server is accepted.
  Identity identity;
  ChannelLimits limits;
  /// Silence after which it looks for another server at the same address, without giving up the old connection yet.
  double knock_after_s = 1.0;
};

struct ClientEvent {
  enum class Kind : std::uint8_t { connected, message, lost };
  Kind kind = Kind::message;
  Reliability reliability = Reliability::reliable;
  Bytes bytes{};         ///< Content of a message.
  std::string reason{};  ///< Reason of a loss, for the log.
};

enum class ClientState : std::uint8_t {
  connecting,  ///< Never connected yet, trying.
  connected,
  lost,  ///< Was connected, trying again.
};

/// Reason why a client has no connection, as far as the client can tell.
enum class Obstacle : std::uint8_t {
  none,              ///< Connected, or no long attempt yet.
  no_answer,         ///< No datagram comes from the server's address.
  other_server_key,  ///< A server there cannot read a message sealed for the pinned key.
  other_version,     ///< The program there speaks another version of the protocol.
  key_unknown,       ///< This client's key is not on the server's list.
  key_in_use,        ///< Another client with this key is connected.
};

class SecureClient {
 public:
  /// The socket must outlive the client.
  SecureClient(DatagramSocket& socket, SecureClientOptions options);
  ~SecureClient();

  std::vector<ClientEvent> pump(double now_s);
  bool has_backlog() const;

  SendResult send(SharedBytes message, Reliability reliability);
  SendResult send(std::span<const std::byte> message, Reliability reliability);
  /// Says goodbye and stays silent from then on.
  void close();

  /// Says goodbye and tries again after a while.
  void leave_for(double seconds);

  ClientState state() const;
  Obstacle obstacle() const;
  /// Reason for the end of the last connection; empty before that.
  const std::string& loss() const;
  /// Time for which the server has owed a reply on this connection; 0 without one. Time without pumping (a client that
  /// draws for seconds) does not count.
  double silence_s() const;
  /// Session of the running connection; the tick lane follows it.
  const SessionId& session() const;
  /// Estimate of the server's `now_s` from pings on this connection; not valid before the first reply.
  const ClockEstimate& clock() const;
  double round_trip_s() const;
  const ChannelCounters& counters() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace septet::net

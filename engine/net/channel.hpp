#pragma once
/// One established connection of the scene lane, the same at both ends: seals and opens data
/// datagrams, acknowledges, and carries both reliabilities (PROTOCOL.md, "Data").

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "engine/net/clock_estimate.hpp"
#include "engine/net/datagram_socket.hpp"
#include "engine/net/handshake.hpp"
#include "engine/net/received_packets.hpp"
#include "engine/net/reliable_receiver.hpp"
#include "engine/net/reliable_sender.hpp"
#include "engine/net/secure_channel.hpp"

namespace septet::net {

/// Bounds one pump, so that a flood of datagrams cannot hold the calling thread.
inline constexpr std::size_t max_datagrams_per_pump = 8192;
inline constexpr std::size_t data_header_bytes = scene_prefix_bytes + 4 + 8;

/// Connection number of a data datagram; empty if it is too short to be one.
std::optional<std::uint32_t> connection_of(std::span<const std::byte> datagram);
/// Terms that this end announces to `peer`, from its limits and its socket's buffer, which `sharers` other ends fill.
Terms terms_of(const ChannelLimits& limits, const DatagramSocket& socket, const Address& peer, std::size_t sharers);
/// True if a connection can be kept on these terms.
bool are_usable(const Terms& terms);

struct ChannelMessage {
  Reliability reliability = Reliability::reliable;
  Bytes bytes;
};

class Channel {
 public:
  struct Options {
    std::uint32_t connection = 0;
    Address peer;
    ChannelKeys keys;
    Terms own, theirs;
    ChannelLimits limits;
  };
  Channel(const Options& options, double now_s);

  enum class Verdict : std::uint8_t {
    good,
    refused,  ///< Counted, state unchanged.
    broken,   ///< Authentic but against the protocol: disconnect.
    goodbye,
  };
  /// Opens a datagram that carries this connection's number, and appends the messages that it completes.
  Verdict accept(const ReceivedDatagram& datagram, double now_s, std::vector<ChannelMessage>& messages);

  SendResult send(SharedBytes message, Reliability reliability);
  void ping() { ping_due_ = true; }
  void say_goodbye(std::string_view reason, DatagramSocket& socket);

  /// Detects losses; once per pump, after receiving.
  void advance_to(double now_s) { sender_.advance_to(now_s); }
  /// Sends due frames, up to about `budget_bytes` of new or resent fragments; returns the number of bytes sent.
  std::size_t emit(DatagramSocket& socket, double now_s, std::size_t budget_bytes);
  bool wants_to_send() const { return sender_.wants_to_send(); }

  std::uint32_t connection() const { return options_.connection; }
  /// Reason in the other end's goodbye; any bytes.
  const std::string& goodbye() const { return goodbye_; }
  const Address& peer() const { return options_.peer; }
  double heard_s() const { return heard_s_; }
  double round_trip_s() const { return sender_.round_trip().smoothed_s(); }
  const ClockEstimate& clock() const { return clock_; }
  std::size_t queued_bytes() const { return sender_.queued_bytes(); }
  ChannelCounters counters() const;

 private:
  Verdict take(const Frame& frame, double now_s, double arrived_s, std::vector<ChannelMessage>& messages);
  bool seal_and_send(DatagramSocket& socket);

  Options options_;
  std::size_t max_text_bytes_;  ///< Bound on the frames of one datagram.
  ReliableSender sender_;
  ReliableReceiver receiver_;
  ReceivedPackets received_;
  std::uint64_t next_number_ = 0;
  double heard_s_;
  bool acknowledge_due_ = false, ping_due_ = false;
  std::deque<Frame> pongs_;
  std::deque<SharedBytes> unreliable_;
  std::size_t unreliable_bytes_ = 0;
  ClockEstimate clock_;
  ChannelCounters counters_;
  std::string goodbye_;
  Bytes text_, datagram_;  ///< Buffers of the current datagram; kept to spare allocations.
  std::vector<Bytes> completed_;
};

}  // namespace septet::net

#pragma once
/// The receiving end of the tick lane: verifies, reassembles and delivers each tick at most once.
///
/// Ticks are delivered as they become complete, so a repaired tick may follow a newer one; the reader keys them by tick
/// id. Memory is bounded for any input: nothing is stored before its signature holds, and only the newest `window`
/// ticks are under reassembly. Datagrams that are not from the followed server and session change only counters.

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/net/datagram_socket.hpp"
#include "engine/net/keys.hpp"
#include "engine/net/tick_datagram.hpp"

namespace septet::net {

struct ReceivedTick {
  std::uint64_t tick = 0;
  Bytes payload;
  bool repaired = false;  ///< A repetition supplied at least one of its fragments.
};

struct TickReceiverCounters {
  std::uint64_t datagrams = 0;  ///< All datagrams received.
  std::uint64_t ticks = 0;      ///< Ticks complete and delivered.
  std::uint64_t repaired = 0;   ///< Ticks among those that a repetition completed.
  /// Ticks that left the window incomplete, or were never seen between two complete ones.
  std::uint64_t lost = 0;
  std::uint64_t forged = 0;         ///< Signature or fragment hash does not hold.
  std::uint64_t other_session = 0;  ///< Datagrams of an earlier or unknown run of the server.
  std::uint64_t malformed = 0;      ///< Not a tick datagram, truncated, or fields that contradict each other.
  std::uint64_t oversized = 0;      ///< Claims more than max_tick_bytes.
  std::uint64_t replayed = 0;       ///< Older than the window.
  std::uint64_t duplicates = 0;     ///< Already held or delivered (every repetition of a fragment that arrived is one).
};

class TickReceiver {
 public:
  static constexpr std::size_t window = 8;  ///< Publications under reassembly.

  /// Refuses every datagram before `follow`: a session id comes over the authenticated scene lane.
  explicit TickReceiver(const PublicKey& server) : server_(server) {}
  /// Forgets the earlier session and returns true, if this is another one. Within one session, delivered ticks are not
  /// delivered again.
  bool follow(const SessionId& session);

  void accept(std::span<const std::byte> datagram);
  /// Accepts all datagrams in the socket.
  void receive_from(DatagramSocket& socket);
  /// The next complete tick, in order of completion.
  std::optional<ReceivedTick> next();

  const TickReceiverCounters& counters() const { return counters_; }
  /// Bytes held for reassembly and for complete ticks not yet taken.
  std::size_t bytes_held() const;

 private:
  /// One publication: under reassembly, or complete and remembered, so that it is not delivered twice.
  struct Assembly {
    TickHeader header;
    Bytes payload;
    std::vector<bool> have;
    std::size_t missing = 0;
    bool repaired = false;
  };
  Assembly* find(std::uint64_t sequence);
  Assembly& start(const TickHeader& header);
  void move_window(std::uint64_t newest);
  void complete(Assembly& assembly);

  PublicKey server_;
  std::optional<SessionId> session_;
  std::optional<std::uint64_t> first_sequence_;
  std::uint64_t newest_sequence_ = 0;
  std::deque<Assembly> assemblies_;    ///< Ascending sequence.
  std::deque<ReceivedTick> complete_;  ///< Oldest are dropped where the reader is too slow.
  TickReceiverCounters counters_;
};

}  // namespace septet::net

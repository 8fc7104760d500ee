#pragma once
/// A simulated network in one process, on simulated time, for tests: seeded loss, latency, jitter (hence reordering)
/// and duplication, and bounded receive buffers. The same seed and traffic give the same faults.
///
///     BadNetwork network({.loss = 0.05, .latency_s = 0.0005, .jitter_s = 0.020}, 42);
///     auto server = network.open({0x0a000001, 4750});
///     network.advance_to(now_s);   // then let both ends pump with the same now_s

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/random.hpp"
#include "engine/net/datagram_socket.hpp"

namespace septet::net {

struct NetworkFaults {
  double loss = 0.0;         ///< Probability that one receiver misses a datagram.
  double duplication = 0.0;  ///< Probability that a receiver gets a datagram twice.
  double latency_s = 0.0002;
  double jitter_s = 0.0;                       ///< Added to the latency, uniform in [0, jitter_s).
  std::size_t receive_buffer_bytes = 4 << 20;  ///< Per socket; datagrams beyond it are lost.
};

struct TrafficCount {
  std::uint64_t datagrams = 0;
  std::uint64_t bytes = 0;
  std::size_t largest_bytes = 0;
};

class BadNetwork {
 public:
  BadNetwork(const NetworkFaults& faults, std::uint64_t seed);
  ~BadNetwork();
  BadNetwork(const BadNetwork&) = delete;
  BadNetwork& operator=(const BadNetwork&) = delete;

  /// Opens a socket at this address (its port must be neither 0 nor taken). The network must outlive it.
  std::unique_ptr<DatagramSocket> open(const Address& address);
  /// Opens a socket that receives datagrams sent to `group`, and sends from `own`.
  std::unique_ptr<DatagramSocket> open_group(const Address& group, const Address& own);

  /// Advances simulated time; datagrams due by then can be received. Time never goes back.
  void advance_to(double now_s);
  /// Applies to datagrams sent from now on.
  void set_faults(const NetworkFaults& faults) { faults_ = faults; }
  /// Multiplies `NetworkFaults::latency_s` from one machine to another, in this direction only.
  void set_latency_share(std::uint32_t from_ip, std::uint32_t to_ip, double share) {
    latency_shares_[{from_ip, to_ip}] = share;
  }
  /// Traffic sent by the socket at this address: before any fault, counted once per send, however many receive it.
  TrafficCount sent_by(const Address& address) const;

  struct Socket;

 private:
  struct Flight {
    Address from;
    Bytes bytes;
    Socket* to;
  };
  void send(const Address& from, const Address& to, std::span<const std::byte> bytes);
  void launch(const Address& from, Socket& to, std::span<const std::byte> bytes);
  void close(Socket& socket);

  NetworkFaults faults_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> latency_shares_;  ///< 1 for pairs that are absent.
  Random random_;
  double now_s_ = 0.0;
  std::uint64_t launches_ = 0;
  std::map<std::pair<double, std::uint64_t>, Flight> in_flight_;  ///< Sorted by due time, then by order of sending.
  std::vector<Socket*> sockets_;
  std::map<Address, TrafficCount> sent_;
};

}  // namespace septet::net

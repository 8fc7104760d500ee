#include "tests/engine/net/bad_network.hpp"

#include <algorithm>

#include "engine/core/check.hpp"

namespace septet::net {

struct BadNetwork::Socket final : DatagramSocket {
  Socket(BadNetwork& owner, const Address& own_address, const Address& heard_address)
      : network(owner), own(own_address), hears(heard_address) {
    network.sockets_.push_back(this);
  }
  ~Socket() override { network.close(*this); }

  bool send(const Address& to, std::span<const std::byte> bytes) override {
    network.send(own, to, bytes);
    return true;
  }
  void flush() override {}
  std::optional<ReceivedDatagram> receive() override {
    if (arrived.empty()) return std::nullopt;
    taken = std::move(arrived.front());
    arrived.pop_front();
    arrived_bytes -= taken.bytes.size();
    return ReceivedDatagram{taken.from, taken.bytes, taken.at_s};
  }
  std::size_t receive_buffer_bytes() const override { return network.faults_.receive_buffer_bytes; }

  BadNetwork& network;
  Address own, hears;
  struct Arrival {
    Address from;
    Bytes bytes;
    double at_s = 0.0;
  };
  std::deque<Arrival> arrived;
  std::size_t arrived_bytes = 0;
  Arrival taken;
};

BadNetwork::BadNetwork(const NetworkFaults& faults, std::uint64_t seed) : faults_(faults), random_(seed) {}

BadNetwork::~BadNetwork() { SEPTET_CHECK(sockets_.empty(), "{} sockets outlive their network", sockets_.size()); }

std::unique_ptr<DatagramSocket> BadNetwork::open(const Address& address) {
  const bool taken =
      std::any_of(sockets_.begin(), sockets_.end(), [&](const Socket* socket) { return socket->hears == address; });
  SEPTET_CHECK(address.port != 0 && !taken, "{} cannot be opened", to_text(address));
  return std::make_unique<Socket>(*this, address, address);
}

std::unique_ptr<DatagramSocket> BadNetwork::open_group(const Address& group, const Address& own) {
  return std::make_unique<Socket>(*this, own, group);
}

void BadNetwork::send(const Address& from, const Address& to, std::span<const std::byte> bytes) {
  TrafficCount& count = sent_[from];
  ++count.datagrams;
  count.bytes += bytes.size();
  count.largest_bytes = std::max(count.largest_bytes, bytes.size());
  for (Socket* socket : sockets_) {
    if (socket->hears != to) continue;
    if (random_.uniform() >= faults_.loss) launch(from, *socket, bytes);
    if (random_.uniform() < faults_.duplication) launch(from, *socket, bytes);
  }
}

void BadNetwork::launch(const Address& from, Socket& to, std::span<const std::byte> bytes) {
  const auto path = latency_shares_.find({from.ip, to.own.ip});
  const double share = path == latency_shares_.end() ? 1.0 : path->second;
  const double due_s = now_s_ + share * faults_.latency_s + faults_.jitter_s * random_.uniform();
  in_flight_.emplace(std::pair{due_s, launches_++}, Flight{from, Bytes(bytes.begin(), bytes.end()), &to});
}

void BadNetwork::advance_to(double now_s) {
  SEPTET_CHECK(now_s >= now_s_, "time goes back from {} to {}", now_s_, now_s);
  now_s_ = now_s;
  while (!in_flight_.empty() && in_flight_.begin()->first.first <= now_s) {
    const double due_s = in_flight_.begin()->first.first;
    Flight flight = std::move(in_flight_.extract(in_flight_.begin()).mapped());
    Socket& to = *flight.to;
    if (to.arrived_bytes + flight.bytes.size() > faults_.receive_buffer_bytes) continue;
    to.arrived_bytes += flight.bytes.size();
    to.arrived.push_back({flight.from, std::move(flight.bytes), due_s});
  }
}

TrafficCount BadNetwork::sent_by(const Address& address) const {
  const auto found = sent_.find(address);
  return found == sent_.end() ? TrafficCount{} : found->second;
}

void BadNetwork::close(Socket& socket) {
  std::erase(sockets_, &socket);
  std::erase_if(in_flight_, [&](const auto& flight) { return flight.second.to == &socket; });
}

}  // namespace septet::net

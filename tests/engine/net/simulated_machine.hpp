#pragma once
/// A machine of a simulated site: its own clock, with an offset and a drift from true time, and sockets whose arrivals
/// are stamped by that clock. Programs on it are pumped with `clock_s`, never with the true time.

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "engine/core/random.hpp"
#include "tests/engine/net/bad_network.hpp"

namespace septet::net {

class SimulatedMachine {
 public:
  /// `drift`: relative excess rate of the clock, 100e-6 at most for a quartz. The machine must not move while sockets
  /// are open.
  SimulatedMachine(BadNetwork& network, std::uint32_t ip, double ahead_s, double drift)
      : network_(network), ip_(ip), ahead_s_(ahead_s), drift_(drift) {}
  SimulatedMachine(const SimulatedMachine&) = delete;
  SimulatedMachine& operator=(const SimulatedMachine&) = delete;

  double clock_s(double true_s) const { return ahead_s_ + (1.0 + drift_) * true_s; }
  /// Sets the clock forward by this amount. Steady clocks never go back.
  void set_clock_forward(double by_s) { ahead_s_ += by_s; }

  std::unique_ptr<DatagramSocket> open(std::uint16_t port) { return wrap(network_.open({ip_, port})); }
  std::unique_ptr<DatagramSocket> open_group(const Address& group, std::uint16_t port) {
    return wrap(network_.open_group(group, {ip_, port}));
  }

 private:
  struct Socket final : DatagramSocket {
    Socket(const SimulatedMachine& its_machine, std::unique_ptr<DatagramSocket> true_socket)
        : machine(its_machine), socket(std::move(true_socket)) {}
    bool send(const Address& to, std::span<const std::byte> bytes) override { return socket->send(to, bytes); }
    void flush() override { socket->flush(); }
    std::optional<ReceivedDatagram> receive() override {
      auto datagram = socket->receive();
      if (datagram && datagram->arrived_s) datagram->arrived_s = machine.clock_s(*datagram->arrived_s);
      return datagram;
    }
    std::size_t receive_buffer_bytes() const override { return socket->receive_buffer_bytes(); }
    const SimulatedMachine& machine;
    std::unique_ptr<DatagramSocket> socket;
  };
  std::unique_ptr<DatagramSocket> wrap(std::unique_ptr<DatagramSocket> socket) {
    return std::make_unique<Socket>(*this, std::move(socket));
  }

  BadNetwork& network_;
  std::uint32_t ip_;
  double ahead_s_, drift_;
};

/// A machine whose clock agrees with no other: up to three hours ahead and up to 100 ppm too fast or too slow. The
/// paths from and to `peer_ip` take unequal shares of the network's latency.
inline std::unique_ptr<SimulatedMachine> machine_of_its_own(BadNetwork& network, std::uint32_t ip,
                                                            std::uint32_t peer_ip, Random& random) {
  const double share = random.uniform(0.7, 1.3);
  network.set_latency_share(peer_ip, ip, share);
  network.set_latency_share(ip, peer_ip, 2.0 - share);
  const double ahead_s = random.uniform(0.0, 10'000.0), drift = random.uniform(-100e-6, 100e-6);
  return std::make_unique<SimulatedMachine>(network, ip, ahead_s, drift);
}

}  // namespace septet::net

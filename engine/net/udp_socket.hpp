#pragma once
/// A non-blocking IPv4 UDP socket that sends and receives in batches (sendmmsg, recvmmsg).
///
/// One thread at a time. Errors of opening say which port or interface and what to do; once open, a
/// socket does not fail: what the system refuses to send is a lost datagram and counted.

#include <memory>
#include <span>

#include "engine/net/datagram_socket.hpp"

namespace septet::net {

struct UdpOptions {
  Address bind;             ///< Port 0: any free one. A multicast address: only that group's datagrams come in.
  bool share_port = false;  ///< Several sockets may bind it (the screens of one machine on one group).
  std::size_t buffer_bytes = 4 << 20;  ///< Asked of the system for each direction; it may give less.
};

/// How a socket sends to and hears groups. The interface is the IPv4 address of a local one; 0
/// leaves it to the routes.
struct MulticastOptions {
  std::uint32_t interface_ip = 0;
  int time_to_live = 1;  ///< 1 stays on the local network.
  bool loopback = true;  ///< Also to sockets of this machine.
};

class UdpSocket final : public DatagramSocket {
 public:
  static Expected<UdpSocket> open(const UdpOptions& options);
  /// Binds a group's address and port (shared) and joins it on one interface.
  static Expected<UdpSocket> open_group(const Address& group, std::uint32_t interface_ip);

  UdpSocket(UdpSocket&&) noexcept;
  UdpSocket& operator=(UdpSocket&&) noexcept;
  ~UdpSocket() override;

  Expected<void> set_multicast(const MulticastOptions& options);
  Expected<void> join_group(const Address& group, std::uint32_t interface_ip);

  bool send(const Address& to, std::span<const std::byte> bytes) override;
  void flush() override;
  std::optional<ReceivedDatagram> receive() override;
  std::size_t receive_buffer_bytes() const override;

  /// With the port that the system chose.
  const Address& local_address() const;
  /// Datagrams that the system refused (no route, interface down).
  std::uint64_t refused() const;
  int file_descriptor() const;

 private:
  struct State;
  explicit UdpSocket(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Sleeps until one of the sockets has something to receive or the time has passed; true: something
/// has arrived. A signal ends the wait early with false.
bool wait_readable(std::span<const UdpSocket* const> sockets, double timeout_s);

}  // namespace septet::net

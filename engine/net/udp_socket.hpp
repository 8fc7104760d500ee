#pragma once
/// A non-blocking IPv4 UDP socket that sends and receives in batches (sendmmsg, recvmmsg).
///
/// One thread at a time. Errors of opening name the port or interface and the remedy; an open socket does not fail: a
/// datagram that the system refuses to send is lost and counted.

#include <memory>
#include <span>

#include "engine/net/datagram_socket.hpp"

namespace septet::net {

struct UdpOptions {
  Address bind;             ///< Port 0: any free one. A multicast address: only that group's datagrams are received.
  bool share_port = false;  ///< Lets several sockets bind it (the screens of one machine on one group).
  std::size_t buffer_bytes = 4 << 20;  ///< Requested for each direction; the system may grant less.
};

/// Options of a socket for sending to and receiving from groups. The interface is the IPv4 address of a local one; 0
/// leaves it to the routes.
struct MulticastOptions {
  std::uint32_t interface_ip = 0;
  int time_to_live = 1;  ///< 1 stays on the local network.
  bool loopback = true;  ///< Delivers also to sockets of this machine.
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

  /// Includes the port that the system chose.
  const Address& local_address() const;
  /// Datagrams that the system refused (no route, interface down).
  std::uint64_t refused() const;
  int file_descriptor() const;

 private:
  struct State;
  explicit UdpSocket(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Sleeps until one of the sockets has a datagram or the time has passed; true: one has arrived. A signal ends the wait
/// early with false.
bool wait_readable(std::span<const UdpSocket* const> sockets, double timeout_s);

}  // namespace septet::net

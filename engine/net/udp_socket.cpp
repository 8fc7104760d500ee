#include "engine/net/udp_socket.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "engine/core/check.hpp"

namespace septet::net {
namespace {

constexpr std::size_t batch = 64;
constexpr std::size_t slot_bytes = 65536;

sockaddr_in to_sockaddr(const Address& address) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_addr.s_addr = htonl(address.ip);
  result.sin_port = htons(address.port);
  return result;
}

Address to_address(const sockaddr_in& from) { return {ntohl(from.sin_addr.s_addr), ntohs(from.sin_port)}; }

/// `batch` datagrams of one direction with the structures that sendmmsg and recvmmsg need.
struct Batch {
  /// Not cleared, so that pages which no datagram reaches cost nothing.
  std::unique_ptr<std::byte[]> bytes = std::make_unique_for_overwrite<std::byte[]>(batch * slot_bytes);
  std::array<sockaddr_in, batch> addresses{};
  std::array<iovec, batch> spans{};
  std::array<mmsghdr, batch> headers{};
  /// Ancillary data of each received datagram: its arrival time.
  struct alignas(cmsghdr) Notes {
    std::array<std::byte, CMSG_SPACE(sizeof(timespec))> bytes;
  };
  std::array<Notes, batch> notes{};
  double steady_from_wall_s = 0.0;  ///< Offset between the clocks when these slots were received.
  std::size_t begin = 0, end = 0;   ///< Slots in use.

  Batch() {
    for (std::size_t i = 0; i < batch; ++i) {
      spans[i] = {bytes.get() + i * slot_bytes, slot_bytes};
      headers[i].msg_hdr = {};
      headers[i].msg_hdr.msg_name = &addresses[i];
      headers[i].msg_hdr.msg_namelen = sizeof(sockaddr_in);
      headers[i].msg_hdr.msg_iov = &spans[i];
      headers[i].msg_hdr.msg_iovlen = 1;
    }
  }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;
};

double clock_s(clockid_t clock) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Arrival by the steady clock; the system stamps with the wall clock.
std::optional<double> arrival_s(msghdr& header, double steady_from_wall_s) {
  for (cmsghdr* note = CMSG_FIRSTHDR(&header); note != nullptr; note = CMSG_NXTHDR(&header, note)) {
    if (note->cmsg_level != SOL_SOCKET || note->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec stamp{};
    std::memcpy(&stamp, CMSG_DATA(note), sizeof stamp);
    return static_cast<double>(stamp.tv_sec) + 1e-9 * static_cast<double>(stamp.tv_nsec) + steady_from_wall_s;
  }
  return std::nullopt;
}

tl::unexpected<Error> bind_failure(const Address& address, int error) {
  const std::string where = "udp " + to_text(address);
  if (error == EADDRINUSE)
    return failure(
        "the port is in use by another program", where,
        fmt::format("end it (`ss -lunp sport = :{}` names it) or set another port in the rig", address.port));
  if (error == EADDRNOTAVAIL)
    return failure("no interface of this machine has this address", where,
                   "set one that `ip -4 address` lists, or 0.0.0.0");
  if (error == EACCES) return failure("this user may not open the port", where, "set a port above 1023");
  return failure(std::strerror(error), where, "check the address and port in the rig");
}

}  // namespace

struct UdpSocket::State {
  int descriptor = -1;
  Address local;
  std::size_t receive_buffer_bytes = 0;
  std::uint64_t refused = 0;
  Batch incoming, outgoing;

  ~State() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

UdpSocket::UdpSocket(std::unique_ptr<State> state) : state_(std::move(state)) {}
UdpSocket::UdpSocket(UdpSocket&&) noexcept = default;
UdpSocket& UdpSocket::operator=(UdpSocket&&) noexcept = default;
UdpSocket::~UdpSocket() = default;

Expected<UdpSocket> UdpSocket::open(const UdpOptions& options) {
  auto state = std::make_unique<State>();
  const std::string where = "udp " + to_text(options.bind);
  state->descriptor = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (state->descriptor < 0)
    return failure(fmt::format("no socket to be had: {}", std::strerror(errno)), where,
                   "close programs or raise `ulimit -n`");
  const int descriptor = state->descriptor;
  const int on = 1, off = 0;
  if (options.share_port) ::setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  // Without this, Linux hands a socket the datagrams of groups that other sockets joined.
  ::setsockopt(descriptor, IPPROTO_IP, IP_MULTICAST_ALL, &off, sizeof off);
  ::setsockopt(descriptor, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
  const int size = static_cast<int>(options.buffer_bytes);
  for (const auto& [forced, plain] : {std::pair{SO_RCVBUFFORCE, SO_RCVBUF}, std::pair{SO_SNDBUFFORCE, SO_SNDBUF}})
    if (::setsockopt(descriptor, SOL_SOCKET, forced, &size, sizeof size) != 0)
      ::setsockopt(descriptor, SOL_SOCKET, plain, &size, sizeof size);

  const sockaddr_in local = to_sockaddr(options.bind);
  if (::bind(descriptor, reinterpret_cast<const sockaddr*>(&local), sizeof local) != 0)
    return bind_failure(options.bind, errno);
  sockaddr_in bound{};
  socklen_t length = sizeof bound;
  ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&bound), &length);
  state->local = to_address(bound);
  int granted = 0;
  length = sizeof granted;
  ::getsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &granted, &length);
  state->receive_buffer_bytes = static_cast<std::size_t>(granted);
  return UdpSocket(std::move(state));
}

Expected<UdpSocket> UdpSocket::open_group(const Address& group, std::uint32_t interface_ip) {
  auto socket = open({.bind = group, .share_port = true});
  if (!socket) return socket;
  if (auto joined = socket->join_group(group, interface_ip); !joined) return tl::unexpected(joined.error());
  return socket;
}

Expected<void> UdpSocket::set_multicast(const MulticastOptions& options) {
  const in_addr interface { htonl(options.interface_ip) };
  if (::setsockopt(state_->descriptor, IPPROTO_IP, IP_MULTICAST_IF, &interface, sizeof interface) != 0)
    return failure("no interface for multicast has this address", "interface " + ip_text(options.interface_ip),
                   "set one that `ip -4 address` lists in the rig");
  const int time_to_live = options.time_to_live, loopback = options.loopback ? 1 : 0;
  ::setsockopt(state_->descriptor, IPPROTO_IP, IP_MULTICAST_TTL, &time_to_live, sizeof time_to_live);
  ::setsockopt(state_->descriptor, IPPROTO_IP, IP_MULTICAST_LOOP, &loopback, sizeof loopback);
  return {};
}

Expected<void> UdpSocket::join_group(const Address& group, std::uint32_t interface_ip) {
  ip_mreq request{};
  request.imr_multiaddr.s_addr = htonl(group.ip);
  request.imr_interface.s_addr = htonl(interface_ip);
  if (::setsockopt(state_->descriptor, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) != 0)
    return failure(fmt::format("the group cannot be joined: {}", std::strerror(errno)),
                   fmt::format("group {} on interface {}", to_text(group), ip_text(interface_ip)),
                   "give a group from 239.0.0.0/8 and an interface that `ip -4 address` lists, or let the "
                   "server use unicast");
  return {};
}

bool UdpSocket::send(const Address& to, std::span<const std::byte> bytes) {
  SEPTET_CHECK(bytes.size() < slot_bytes, "datagram of {} bytes", bytes.size());
  Batch& queue = state_->outgoing;
  if (queue.end == batch) flush();
  if (queue.end == batch) return false;
  queue.addresses[queue.end] = to_sockaddr(to);
  queue.spans[queue.end].iov_len = bytes.size();
  std::copy(bytes.begin(), bytes.end(), static_cast<std::byte*>(queue.spans[queue.end].iov_base));
  ++queue.end;
  return true;
}

void UdpSocket::flush() {
  Batch& queue = state_->outgoing;
  while (queue.begin < queue.end) {
    const int sent =
        ::sendmmsg(state_->descriptor, &queue.headers[queue.begin], static_cast<unsigned>(queue.end - queue.begin), 0);
    if (sent > 0) {
      queue.begin += static_cast<std::size_t>(sent);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOBUFS) {
      return;  // Stays queued for the next flush.
    } else if (errno != EINTR) {
      ++queue.begin;
      ++state_->refused;
    }
  }
  queue.begin = queue.end = 0;
}

std::optional<ReceivedDatagram> UdpSocket::receive() {
  Batch& queue = state_->incoming;
  if (queue.begin == queue.end) {
    queue.begin = queue.end = 0;
    for (std::size_t i = 0; i < batch; ++i) {
      queue.headers[i].msg_hdr.msg_control = &queue.notes[i];
      queue.headers[i].msg_hdr.msg_controllen = sizeof queue.notes[i];
    }
    int received;
    do {
      received = ::recvmmsg(state_->descriptor, queue.headers.data(), batch, MSG_DONTWAIT, nullptr);
    } while (received < 0 && errno == EINTR);
    if (received <= 0) return std::nullopt;
    queue.end = static_cast<std::size_t>(received);
    queue.steady_from_wall_s = clock_s(CLOCK_MONOTONIC) - clock_s(CLOCK_REALTIME);
  }
  const std::size_t slot = queue.begin++;
  const auto* first = static_cast<const std::byte*>(queue.spans[slot].iov_base);
  return ReceivedDatagram{to_address(queue.addresses[slot]),
                          {first, queue.headers[slot].msg_len},
                          arrival_s(queue.headers[slot].msg_hdr, queue.steady_from_wall_s)};
}

std::size_t UdpSocket::receive_buffer_bytes() const { return state_->receive_buffer_bytes; }
const Address& UdpSocket::local_address() const { return state_->local; }
std::uint64_t UdpSocket::refused() const { return state_->refused; }
int UdpSocket::file_descriptor() const { return state_->descriptor; }

bool wait_readable(std::span<const UdpSocket* const> sockets, double timeout_s) {
  std::vector<pollfd> waiting;
  for (const UdpSocket* socket : sockets) waiting.push_back({socket->file_descriptor(), POLLIN, 0});
  const double whole_s = std::floor(std::max(timeout_s, 0.0));
  const timespec limit{static_cast<time_t>(whole_s), static_cast<long>((std::max(timeout_s, 0.0) - whole_s) * 1e9)};
  return ::ppoll(waiting.data(), waiting.size(), &limit, nullptr) > 0;
}

}  // namespace septet::net

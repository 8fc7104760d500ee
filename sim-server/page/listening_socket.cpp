#include "sim-server/page/listening_socket.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace septet::page {
namespace {

constexpr int tries_of_any_port = 20;  ///< Attempts to find one free on both addresses.

tl::unexpected<Error> no_port(int reason, std::string_view address, std::uint16_t port) {
  return failure(std::strerror(reason), fmt::format("the operator's page, {}:{}", address, port),
                 "choose another port, or 0 for any free one");
}

constexpr std::string_view address_v4 = "127.0.0.1", address_v6 = "[::1]";

void close_file(int& file) {
  if (file >= 0) ::close(std::exchange(file, -1));
}

/// The port on which a socket listens at this machine's own address of its family; 0: it does not.
std::uint16_t own_port(int file) {
  sockaddr_storage place{};
  socklen_t size = sizeof place;
  int listens = 0;
  socklen_t listens_size = sizeof listens;
  if (::getsockname(file, reinterpret_cast<sockaddr*>(&place), &size) != 0 ||
      ::getsockopt(file, SOL_SOCKET, SO_ACCEPTCONN, &listens, &listens_size) != 0 || listens == 0)
    return 0;
  if (place.ss_family == AF_INET) {
    const auto& own = reinterpret_cast<const sockaddr_in&>(place);
    return own.sin_addr.s_addr == htonl(INADDR_LOOPBACK) ? ntohs(own.sin_port) : std::uint16_t{0};
  }
  const auto& own = reinterpret_cast<const sockaddr_in6&>(place);
  return place.ss_family == AF_INET6 && IN6_IS_ADDR_LOOPBACK(&own.sin6_addr) ? ntohs(own.sin6_port) : std::uint16_t{0};
}

/// Listens at the address; an error number where it cannot.
int listen_at(int& file, const sockaddr* place, socklen_t size) {
  const int yes = 1;
  file = ::socket(place->sa_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (file < 0) return errno;
  if (place->sa_family == AF_INET6) ::setsockopt(file, IPPROTO_IPV6, IPV6_V6ONLY, &yes, sizeof yes);
  if (::setsockopt(file, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) == 0 && ::bind(file, place, size) == 0 &&
      ::listen(file, SOMAXCONN) == 0)
    return 0;
  const int reason = errno;
  close_file(file);
  return reason;
}

/// This machine has no such address: no browser can use it.
bool is_no_address(int reason) {
  return reason == EAFNOSUPPORT || reason == EADDRNOTAVAIL || reason == EPROTONOSUPPORT;
}

}  // namespace

void ListeningFiles::close() {
  close_file(ipv4);
  close_file(ipv6);
}

Expected<ListeningSocket> ListeningSocket::open(std::uint16_t port) {
  for (int tries = 1;; ++tries) {
    ListeningSocket made({}, port);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (const int reason = listen_at(made.files_.ipv4, reinterpret_cast<const sockaddr*>(&place), sizeof place))
      return no_port(reason, address_v4, port);
    made.port_ = own_port(made.files_.ipv4);
    sockaddr_in6 other{};
    other.sin6_family = AF_INET6;
    other.sin6_port = htons(made.port_);
    other.sin6_addr = in6addr_loopback;
    const int reason = listen_at(made.files_.ipv6, reinterpret_cast<const sockaddr*>(&other), sizeof other);
    if (reason == 0 || is_no_address(reason)) return made;
    if (port != 0 || tries == tries_of_any_port) return no_port(reason, address_v6, made.port_);
  }
}

Expected<ListeningSocket> ListeningSocket::take(ListeningFiles files) {
  const std::uint16_t port = own_port(files.ipv4);
  if (port == 0 || (files.ipv6 >= 0 && own_port(files.ipv6) != port))
    return failure("what was handed over listens nowhere on 127.0.0.1", handover_variable,
                   fmt::format("start without the environment variable {}", handover_variable));
  for (const int file : {files.ipv4, files.ipv6})
    if (file >= 0) ::fcntl(file, F_SETFD, FD_CLOEXEC);
  return ListeningSocket(files, port);
}

Expected<ListeningFiles> ListeningSocket::copy(bool inherited) const {
  ListeningFiles made;
  const int how = inherited ? F_DUPFD : F_DUPFD_CLOEXEC;
  made.ipv4 = ::fcntl(files_.ipv4, how, 3);
  if (made.ipv4 >= 0 && files_.ipv6 >= 0) made.ipv6 = ::fcntl(files_.ipv6, how, 3);
  if (made.ipv4 >= 0 && (files_.ipv6 < 0 || made.ipv6 >= 0)) return made;
  const int reason = errno;
  made.close();
  return no_port(reason, address_v4, port_);
}

std::string text_of(const Handover& handover) {
  if (handover.files.ipv6 < 0) return fmt::format("{} {}", handover.files.ipv4, handover.token);
  return fmt::format("{}+{} {}", handover.files.ipv4, handover.files.ipv6, handover.token);
}

std::optional<Handover> read_handover(std::string_view text) {
  Handover handover;
  const auto take_file = [&](int& file) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), file);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return error == std::errc() && file >= 3;
  };
  if (!take_file(handover.files.ipv4)) return std::nullopt;
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (!take_file(handover.files.ipv6)) return std::nullopt;
  }
  if (text.size() != 33 || text[0] != ' ') return std::nullopt;
  handover.token = text.substr(1);
  const auto is_hexadecimal = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (!std::ranges::all_of(handover.token, is_hexadecimal)) return std::nullopt;
  return handover;
}

}  // namespace septet::page

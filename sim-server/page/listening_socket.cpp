#include "sim-server/page/listening_socket.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace septet::page {
namespace {

tl::unexpected<Error> no_port(int reason, std::uint16_t port) {
  return failure(std::strerror(reason), fmt::format("the operator's page, 127.0.0.1:{}", port),
                 "choose another port, or 0 for any free one");
}

}  // namespace

Expected<ListeningSocket> ListeningSocket::open(std::uint16_t port) {
  ListeningSocket made(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), port);
  const int yes = 1;
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (made.file_ < 0 || ::setsockopt(made.file_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      ::bind(made.file_, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0 ||
      ::listen(made.file_, SOMAXCONN) != 0)
    return no_port(errno, port);
  socklen_t size = sizeof place;
  ::getsockname(made.file_, reinterpret_cast<sockaddr*>(&place), &size);
  made.port_ = ntohs(place.sin_port);
  return made;
}

Expected<ListeningSocket> ListeningSocket::take(int file) {
  sockaddr_in place{};
  socklen_t size = sizeof place;
  int listens = 0;
  socklen_t listens_size = sizeof listens;
  if (::getsockname(file, reinterpret_cast<sockaddr*>(&place), &size) != 0 || place.sin_family != AF_INET ||
      place.sin_addr.s_addr != htonl(INADDR_LOOPBACK) ||
      ::getsockopt(file, SOL_SOCKET, SO_ACCEPTCONN, &listens, &listens_size) != 0 || listens == 0)
    return failure("what was handed over listens nowhere on 127.0.0.1", handover_variable,
                   fmt::format("start without the environment variable {}", handover_variable));
  ::fcntl(file, F_SETFD, FD_CLOEXEC);
  return ListeningSocket(file, ntohs(place.sin_port));
}

ListeningSocket::~ListeningSocket() {
  if (file_ >= 0) ::close(file_);
}

Expected<int> ListeningSocket::copy(bool inherited) const {
  const int file = ::fcntl(file_, inherited ? F_DUPFD : F_DUPFD_CLOEXEC, 3);
  if (file < 0) return no_port(errno, port_);
  return file;
}

std::string text_of(const Handover& handover) { return fmt::format("{} {}", handover.file, handover.token); }

std::optional<Handover> read_handover(std::string_view text) {
  Handover handover;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), handover.file);
  const std::string_view rest = text.substr(static_cast<std::size_t>(end - text.data()));
  if (error != std::errc() || handover.file < 3 || rest.size() != 33 || rest[0] != ' ') return std::nullopt;
  handover.token = rest.substr(1);
  const auto is_hexadecimal = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (!std::ranges::all_of(handover.token, is_hexadecimal)) return std::nullopt;
  return handover;
}

}  // namespace septet::page

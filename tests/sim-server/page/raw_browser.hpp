#pragma once
/// A client of the page's server that can also misbehave: a socket, HTTP as text, WebSocket frames byte by byte.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace septet::page {

/// Token of the servers in these tests.
inline constexpr std::string_view token = "0123456789abcdef0123456789abcdef";

class RawConnection {
 public:
  explicit RawConnection(std::uint16_t port, int receive_bytes = 0, bool by_ipv6 = false)
      : socket_(::socket(by_ipv6 ? AF_INET6 : AF_INET, SOCK_STREAM, 0)) {
    REQUIRE(socket_ >= 0);
    if (receive_bytes > 0) ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_bytes, sizeof receive_bytes);
    const timeval hang{60, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &hang, sizeof hang);
    if (by_ipv6) {
      sockaddr_in6 address{};
      address.sin6_family = AF_INET6;
      address.sin6_port = htons(port);
      address.sin6_addr = in6addr_loopback;
      REQUIRE(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
      return;
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  }
  RawConnection(RawConnection&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)), pending_(std::move(other.pending_)) {}
  RawConnection& operator=(RawConnection&&) = delete;
  ~RawConnection() {
    if (socket_ >= 0) ::close(socket_);
  }

  /// Returns false if the other side has gone.
  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const auto count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }
  void send_no_more() { ::shutdown(socket_, SHUT_WR); }
  /// Acts as a killed program: data sent to it is met with a reset.
  void die() {
    const linger now{1, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &now, sizeof now);
    ::close(std::exchange(socket_, -1));
  }
  /// Reads until the other side closes.
  std::string read_all() {
    while (receive()) {
    }
    return std::exchange(pending_, {});
  }
  /// Reads through the empty line after an HTTP header; returns a partial one if it does not come.
  std::string read_header() {
    while (pending_.find("\r\n\r\n") == std::string::npos)
      if (!receive()) return std::exchange(pending_, {});
    const auto end = pending_.find("\r\n\r\n") + 4;
    std::string header = pending_.substr(0, end);
    pending_.erase(0, end);
    return header;
  }
  std::optional<std::string> read(std::size_t count) {
    while (pending_.size() < count)
      if (!receive()) return std::nullopt;
    std::string bytes = pending_.substr(0, count);
    pending_.erase(0, count);
    return bytes;
  }

 private:
  bool receive() {
    std::array<char, 65536> bytes;
    const auto count = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (count <= 0) return false;
    pending_.append(bytes.data(), static_cast<std::size_t>(count));
    return true;
  }

  int socket_;
  std::string pending_;
};

inline std::string upgrade_request(std::uint16_t port, std::string_view key, std::string_view more = "") {
  return fmt::format(
      "GET /live HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
      "Sec-WebSocket-Protocol: septet, {}\r\n{}\r\n",
      port, key, more);
}

/// A frame as a browser sends it. `first` is the first byte: 0x81 a whole text.
inline std::string client_frame(std::string_view payload, unsigned char first = 0x81) {
  std::string frame(1, static_cast<char>(first));
  if (payload.size() < 126) {
    frame += static_cast<char>(0x80 | payload.size());
  } else {
    frame += static_cast<char>(0x80 | 126);
    frame += static_cast<char>(payload.size() >> 8);
    frame += static_cast<char>(payload.size() & 0xff);
  }
  constexpr std::string_view mask = "mask";
  frame += mask;
  for (std::size_t i = 0; i < payload.size(); ++i) frame += static_cast<char>(payload[i] ^ mask[i % 4]);
  return frame;
}

/// A connection whose WebSocket is open.
class RawBrowser {
 public:
  RawBrowser(std::uint16_t port, std::string_view key, int receive_bytes = 0) : connection_(port, receive_bytes) {
    REQUIRE(connection_.send(upgrade_request(port, key)));
    const std::string header = connection_.read_header();
    REQUIRE_MESSAGE(header.starts_with("HTTP/1.1 101"), header);
  }
  bool say(std::string_view text) { return connection_.send(client_frame(text)); }
  bool send(std::string_view bytes) { return connection_.send(bytes); }
  void die() { connection_.die(); }
  RawConnection& connection() { return connection_; }

  /// The next text; empty if the server has closed.
  std::optional<std::string> hear() {
    while (true) {
      const auto head = connection_.read(2);
      if (!head) return std::nullopt;
      const auto code = static_cast<unsigned char>((*head)[0]) & 0xf;
      std::size_t size = static_cast<unsigned char>((*head)[1]);
      if (size >= 126) {
        const auto longer = connection_.read(size == 126 ? 2 : 8);
        if (!longer) return std::nullopt;
        size = 0;
        for (const char byte : *longer) size = size << 8 | static_cast<unsigned char>(byte);
      }
      auto payload = connection_.read(size);
      if (!payload || code == 8) return std::nullopt;
      if (code == 1) return payload;
    }
  }

 private:
  RawConnection connection_;
};

}  // namespace septet::page

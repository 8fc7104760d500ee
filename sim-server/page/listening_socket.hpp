#pragma once
/// A port of this machine's own addresses (127.0.0.1, and [::1] where there is IPv6) on which a page is served, by one program after the
/// other: who waits for a drive to be chosen hands it to the drive that it starts, and has it back after that. Whoever connects meanwhile
/// waits, and is refused by nobody. Both addresses, for a browser that is asked for "localhost" takes either.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/expected.hpp"

namespace septet::page {

/// The file descriptors of such a port.
struct ListeningFiles {
  int ipv4 = -1;
  int ipv6 = -1;  ///< −1: this machine has no [::1].
  /// Both are closed and forgotten.
  void close();
};

class ListeningSocket {
 public:
  /// 0: any port that is free on both. Error: the port cannot be had; also where another program has it on one of the two addresses alone.
  static Expected<ListeningSocket> open(std::uint16_t port);
  /// What whoever started this program has handed over (`read_handover`). Error: it is no such socket.
  static Expected<ListeningSocket> take(ListeningFiles files);
  ListeningSocket(ListeningSocket&& other) noexcept
      : files_(std::exchange(other.files_, ListeningFiles{})), port_(other.port_) {}
  ListeningSocket& operator=(ListeningSocket&&) = delete;
  ~ListeningSocket() { files_.close(); }

  std::uint16_t port() const { return port_; }
  /// Other file descriptors of it, the caller's own, which programs that are started do not get; or do, if `inherited`.
  Expected<ListeningFiles> copy(bool inherited = false) const;

 private:
  ListeningSocket(ListeningFiles files, std::uint16_t port) : files_(files), port_(port) {}
  ListeningFiles files_;
  std::uint16_t port_;
};

/// What a page is handed over with, in the environment variable `handover_variable`: it is nobody else's to read, as a command line is.
struct Handover {
  ListeningFiles files;
  std::string token;
};
inline constexpr const char* handover_variable = "SEPTET_PAGE";
std::string text_of(const Handover& handover);
/// Nothing where it is none: "FILE TOKEN" or "FILE+FILE TOKEN".
std::optional<Handover> read_handover(std::string_view text);

}  // namespace septet::page

#pragma once
/// A port of this machine's own addresses (127.0.0.1, and [::1] with IPv6) on which a page is served, by one program
/// after the other: the start page hands it to the drive that it starts, and gets it back afterwards. Browsers that
/// connect meanwhile wait, and are not refused. Both addresses, since a browser takes either for "localhost".

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
  /// 0: any port that is free on both. Error: the port is not available; also if another program has it on one of the
  /// two addresses alone.
  static Expected<ListeningSocket> open(std::uint16_t port);
  /// Takes over the parent program's port (`read_handover`). Error: it is no such socket.
  static Expected<ListeningSocket> take(ListeningFiles files);
  ListeningSocket(ListeningSocket&& other) noexcept
      : files_(std::exchange(other.files_, ListeningFiles{})), port_(other.port_) {}
  ListeningSocket& operator=(ListeningSocket&&) = delete;
  ~ListeningSocket() { files_.close(); }

  std::uint16_t port() const { return port_; }
  /// Duplicated file descriptors, owned by the caller, which child programs do not inherit, or do, if `inherited`.
  Expected<ListeningFiles> copy(bool inherited = false) const;

 private:
  ListeningSocket(ListeningFiles files, std::uint16_t port) : files_(files), port_(port) {}
  ListeningFiles files_;
  std::uint16_t port_;
};

/// Handover of a page, in the environment variable `handover_variable`: private, unlike a command line.
struct Handover {
  ListeningFiles files;
  std::string token;
};
inline constexpr const char* handover_variable = "SEPTET_PAGE";
std::string text_of(const Handover& handover);
/// Parses "FILE TOKEN" or "FILE+FILE TOKEN"; empty for anything else.
std::optional<Handover> read_handover(std::string_view text);

}  // namespace septet::page

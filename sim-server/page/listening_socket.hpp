#pragma once
/// A port of this machine's own address (127.0.0.1) on which a page is served, by one program after the other: who waits for a drive to be
/// chosen hands it to the drive that it starts, and has it back after that. Whoever connects meanwhile waits, and is refused by nobody.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/expected.hpp"

namespace septet::page {

class ListeningSocket {
 public:
  /// 0: any free port. Error: the port cannot be had.
  static Expected<ListeningSocket> open(std::uint16_t port);
  /// What whoever started this program has handed over (`handed_text`). Error: it is no such socket.
  static Expected<ListeningSocket> take(int file);
  ListeningSocket(ListeningSocket&& other) noexcept : file_(std::exchange(other.file_, -1)), port_(other.port_) {}
  ListeningSocket& operator=(ListeningSocket&&) = delete;
  ~ListeningSocket();

  std::uint16_t port() const { return port_; }
  /// Another file descriptor of it, the caller's own, which programs that are started do not get; or do, if `inherited`.
  Expected<int> copy(bool inherited = false) const;

 private:
  ListeningSocket(int file, std::uint16_t port) : file_(file), port_(port) {}
  int file_;
  std::uint16_t port_;
};

/// What a page is handed over with, in the environment variable `handover_variable`: it is nobody else's to read, as a command line is.
struct Handover {
  int file = -1;
  std::string token;
};
inline constexpr const char* handover_variable = "SEPTET_PAGE";
std::string text_of(const Handover& handover);
/// Nothing where it is none: "FILE TOKEN".
std::optional<Handover> read_handover(std::string_view text);

}  // namespace septet::page

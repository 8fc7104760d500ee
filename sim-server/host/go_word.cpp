#include "sim-server/host/go_word.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>

namespace septet::server {

bool GoWord::said() {
  // A terminal stops a job in the background that reads from it.
  const bool mine = !::isatty(STDIN_FILENO) || ::tcgetpgrp(STDIN_FILENO) == ::getpgrp();
  pollfd input{STDIN_FILENO, POLLIN, 0};
  while (!said_ && !closed_ && mine && ::poll(&input, 1, 0) > 0) {
    std::array<char, 256> bytes;
    const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count <= 0) closed_ = true;
    for (ssize_t i = 0; i < count && !said_; ++i) {
      const char byte = bytes[static_cast<std::size_t>(i)];
      if (byte == '\n') {
        said_ = line_.empty() || line_ == "go";
        line_.clear();
      } else if (line_.size() < 16) {
        line_ += byte;
      }
    }
  }
  return said_;
}

}  // namespace septet::server

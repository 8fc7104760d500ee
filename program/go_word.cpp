#include "program/go_word.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <utility>

namespace septet::program {

void GoWord::read() {
  // A terminal stops a job in the background that reads from it.
  const bool mine = !::isatty(STDIN_FILENO) || ::tcgetpgrp(STDIN_FILENO) == ::getpgrp();
  pollfd input{STDIN_FILENO, POLLIN, 0};
  while (!closed_ && mine && ::poll(&input, 1, 0) > 0) {
    std::array<char, 256> bytes;
    const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count <= 0) closed_ = true;
    for (ssize_t i = 0; i < count; ++i) {
      const char byte = bytes[static_cast<std::size_t>(i)];
      if (byte == '\n') {
        said_ = said_ || line_.empty() || line_ == "go";
        rearm_ = rearm_ || line_ == "rearm";
        line_.clear();
      } else if (line_.size() < 16) {
        line_ += byte;
      }
    }
  }
}

bool GoWord::said() {
  read();
  return said_;
}

bool GoWord::take_rearm() {
  read();
  return std::exchange(rearm_, false);
}

}  // namespace septet::program

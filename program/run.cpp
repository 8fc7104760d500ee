#include "program/run.hpp"

#include <sys/resource.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <string>

#include "program/console.hpp"
#include "program/stop_signal.hpp"

namespace septet::program {

void keep_private() {
  constexpr mode_t of_others = S_IRWXG | S_IRWXO;
  ::umask(::umask(of_others) | of_others);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
}

int run(std::string_view name, const std::function<Expected<int>()>& work) {
  keep_private();
  survive_failed_writes();
  std::string wrong;
  try {
    const auto status = work();
    if (status) return status_after_output(name, *status);
    wrong = describe(status.error());
  } catch (const std::exception& error) {
    wrong = error.what();
  }
  say(std::string(name) + ": " + wrong);
  return failed_status;
}

int status_after_output(std::string_view name, int status) {
  // Output that ended with a line's end was written at once: the stream remembers its failure.
  const bool written = std::cout.good() && std::fflush(stdout) == 0;
  if (written || errno == EPIPE || status != 0) return status;
  say(std::string(name) + ": standard output: " + std::strerror(errno) + ": make room, then run this again");
  return failed_status;
}

}  // namespace septet::program

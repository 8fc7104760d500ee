#pragma once
/// The clock of a running program; below the programs time is an argument.

#include <chrono>

namespace septet::program {

/// Seconds since about the machine's start: never jumps or goes back.
inline double monotonic_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace septet::program

#pragma once
/// Shared by the suites: they run in a virtual machine of their own, as root, by a clock that does not wait for
/// sleeping programs (README.md).

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <thread>

#include <doctest/doctest.h>

namespace septet::rig_vm {

/// A line for the machine's shell, which must succeed. busybox prefers its own, limited ip and tc: these are /tools/ip
/// and /tools/tc.
inline void command(const std::string& line) { REQUIRE_MESSAGE(std::system(line.c_str()) == 0, line); }

/// The same in destructors, where a failure must not end the test.
inline void last_command(const std::string& line) { CHECK_MESSAGE(std::system(line.c_str()) == 0, line); }

inline double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline void sleep_s(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// True if the condition holds before the time is up; checked a thousand times a second.
inline bool becomes_true(const std::function<bool()>& condition, double within_s = 30.0) {
  for (const double end_s = now_s() + within_s; !condition(); sleep_s(0.001))
    if (now_s() > end_s) return false;
  return true;
}

/// A figure for the test's output.
inline void measured(std::string_view what, double value, std::string_view unit) {
  std::ofstream("/results/measured.txt", std::ios::app) << what << ": " << value << ' ' << unit << '\n';
}

}  // namespace septet::rig_vm

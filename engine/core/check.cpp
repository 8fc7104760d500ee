#include "engine/core/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace septet {

void stop_on_failed_check(std::string_view condition, std::string_view file, int line, const std::string& values) {
  fmt::print(stderr, "septet: a bug: {}:{}: expected {} ({})\n", file, line, condition, values);
  std::fflush(stderr);
  std::abort();
}

}  // namespace septet

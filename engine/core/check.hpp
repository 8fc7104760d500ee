#pragma once
/// A check that always runs. A failed one is a bug of ours: the program stops and prints the values.
///
///     SEPTET_CHECK(first < size, "first {} of {}", first, size);
///
/// Data from outside (wire, file, device) never reaches a check; it is validated and refused with an Error.

#include <string>
#include <string_view>

#include <fmt/core.h>

namespace septet {
[[noreturn]] void stop_on_failed_check(std::string_view condition, std::string_view file, int line,
                                       const std::string& values);
}  // namespace septet

#define SEPTET_CHECK(condition, ...)                                                              \
  do {                                                                                            \
    if (!(condition)) [[unlikely]]                                                                \
      ::septet::stop_on_failed_check(#condition, __FILE__, __LINE__, ::fmt::format(__VA_ARGS__)); \
  } while (false)

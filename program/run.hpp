#pragma once
/// A program from its command line to its exit status.

#include <functional>
#include <string_view>

#include "engine/core/expected.hpp"

namespace septet::program {

inline constexpr int failed_status = 1, wrong_use_status = 2;

/// What this process writes is its user's alone: files 0600, folders 0700 (the user's umask may only narrow that), and no core file, in which keys
/// would lie. Its children inherit both.
void keep_private();

/// Keeps private, does the work of the program `name` and returns its exit status. An error, or an exception that a library throws, is said once and is 1.
/// A failed write is an error of whoever writes, and not the program's end.
int run(std::string_view name, const std::function<Expected<int>()>& work);

/// `status`, or failed_status with a word if what was printed cannot be written, which shows at the end. Who stops reading wants no more of it.
int status_after_output(std::string_view name, int status);

}  // namespace septet::program

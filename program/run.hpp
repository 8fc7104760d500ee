#pragma once
/// A program from its command line to its exit status.

#include <functional>
#include <string_view>

#include "engine/core/expected.hpp"

namespace septet::program {

inline constexpr int failed_status = 1, wrong_use_status = 2;

/// Files of this process are its user's alone: files 0600, folders 0700 (the user's umask may only narrow that), and no
/// core file, which could hold keys. Its children inherit both.
void keep_private();

/// Keeps private, does the work of the program `name` and returns its exit status. An error, or an exception that a
/// library throws, is printed once and gives 1. A failed write is an error of its caller, and does not end the program.
int run(std::string_view name, const std::function<Expected<int>()>& work);

/// `status`, or failed_status with a message if the output cannot be written, which shows at the end. A reader that
/// closes the pipe is no error.
int status_after_output(std::string_view name, int status);

}  // namespace septet::program

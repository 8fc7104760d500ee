#pragma once
/// Last output of a program that writes to a file: its reason, or its progress.

#include <filesystem>
#include <string>

namespace septet::program {

/// The last line that is not empty, fit for a terminal. Empty if there is none.
std::string last_line(const std::filesystem::path& log);

}  // namespace septet::program

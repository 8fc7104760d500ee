#pragma once
/// What a program whose output goes to a file has said last: its reason, or how far it is.

#include <filesystem>
#include <string>

namespace septet::program {

/// The last line that is not empty, fit for a terminal. Empty where there is none.
std::string last_line(const std::filesystem::path& log);

}  // namespace septet::program

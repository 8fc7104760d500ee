#pragma once
/// Last output of a started program, from its log.

#include <filesystem>
#include <string>

namespace septet::server {

/// The last line of a text file that is not blank, made printable; empty if there is none, or no file.
std::string last_line_of(const std::filesystem::path& log);

}  // namespace septet::server

#pragma once
/// What a program that was started has said last, by its log.

#include <filesystem>
#include <string>

namespace septet::server {

/// The last line of a text file that is not blank, made printable; empty where there is none, or no file.
std::string last_line_of(const std::filesystem::path& log);

}  // namespace septet::server

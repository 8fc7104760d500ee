#pragma once
/// `septet report SESSION`: report.html from a session file.

#include <filesystem>
#include <string>

#include "engine/core/expected.hpp"

namespace septet::server {

Expected<int> run_report(const std::string& session, const std::filesystem::path& out);

}  // namespace septet::server

#pragma once
/// Version of this build, in logs and every program's `--version`.

#include <string>
#include <string_view>

namespace septet {

extern const std::string_view version;   ///< Number in CMakeLists.txt and CHANGELOG.md.
extern const std::string_view revision;  ///< Short git commit at configuration; empty outside a checkout.

/// "0.1.0 (6409bab)".
std::string version_text();

}  // namespace septet

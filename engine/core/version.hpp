#pragma once
/// Which Septet this is, as logs and every program's `--version` say.

#include <string>
#include <string_view>

namespace septet {

extern const std::string_view version;   ///< As in CMakeLists.txt and CHANGELOG.md.
extern const std::string_view revision;  ///< Of git, short, when it was configured; empty outside a checkout.

/// "0.1.0 (6409bab)".
std::string version_text();

}  // namespace septet

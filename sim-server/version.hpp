#pragma once
/// Which Septet this is, as logs and `--version` say.

#include <string_view>

namespace septet::server {

extern const std::string_view version;   ///< As in CMakeLists.txt and CHANGELOG.md.
extern const std::string_view revision;  ///< Of git, short; empty outside a checkout.

}  // namespace septet::server

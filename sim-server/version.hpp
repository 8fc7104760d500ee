#pragma once
/// Septet's version, as in CMakeLists.txt and CHANGELOG.md.

#include <string_view>

namespace septet::server {
inline constexpr std::string_view version = SEPTET_VERSION;
}

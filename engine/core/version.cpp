#include "engine/core/version.hpp"

namespace septet {

const std::string_view version = SEPTET_VERSION;
const std::string_view revision = SEPTET_REVISION;

std::string version_text() {
  return std::string(version) + (revision.empty() ? "" : " (" + std::string(revision) + ")");
}

}  // namespace septet

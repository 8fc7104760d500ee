#include "sim-server/version.hpp"

namespace septet::server {

const std::string_view version = SEPTET_VERSION;
const std::string_view revision = SEPTET_REVISION;

}  // namespace septet::server

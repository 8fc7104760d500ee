#include "tests/checkout.hpp"

namespace septet {

std::string source_folder() { return SEPTET_SOURCE_DIR; }

std::string build_folder() { return SEPTET_BINARY_DIR; }

}  // namespace septet

#include "tests/checkout.hpp"

#include <filesystem>

namespace septet {

// Each program lies in its build folder. Where the checkout lies is asked, not compiled in: .ci/verdict takes equal
// programs for one.
std::string build_folder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path().string(); }

std::string source_folder() {
  return std::filesystem::weakly_canonical(std::filesystem::path(build_folder()) / SEPTET_SOURCE_FROM_BUILD).string();
}

}  // namespace septet

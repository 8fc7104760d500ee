#include "program/confinement.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <system_error>

namespace septet::program {
namespace {
namespace fs = std::filesystem;

constexpr std::uint64_t making =
    LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
    LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK |
    LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
constexpr std::uint64_t writing = making | LANDLOCK_ACCESS_FS_WRITE_FILE;
/// From the third version on, truncating without opening for writing is controlled too; the header may be older than
/// the kernel.
constexpr std::uint64_t truncating = 1ull << 14;
constexpr long truncates_since = 3;

fs::path folder_that_is_there(fs::path place) {
  std::error_code error;
  place = fs::absolute(place, error);
  while (!fs::is_directory(place, error) && place.has_relative_path()) place = place.parent_path();
  return place;
}

bool allow(int rules, const fs::path& place, std::uint64_t access) {
  const int folder = ::open(place.c_str(), O_PATH | O_CLOEXEC);
  if (folder < 0) return false;
  landlock_path_beneath_attr below{};
  below.allowed_access = access;
  below.parent_fd = folder;
  const long done = ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &below, 0);
  ::close(folder);
  return done == 0;
}

}  // namespace

bool write_only_below(const std::vector<fs::path>& places) {
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return false;
  const std::uint64_t handled = writing | (version >= truncates_since ? truncating : 0);
  landlock_ruleset_attr what{};
  what.handled_access_fs = handled;
  const auto rules = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &what, sizeof what, 0));
  if (rules < 0) return false;
  std::error_code error;
  const fs::path temporary = fs::temp_directory_path(error);
  bool done = error || allow(rules, temporary, handled);
  for (const fs::path& place : places) done = done && allow(rules, folder_that_is_there(place), handled);
  // A terminal, /dev/null and the like.
  done = done && allow(rules, "/dev", handled & ~making);
  done = done && ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::syscall(SYS_landlock_restrict_self, rules, 0) == 0;
  ::close(rules);
  return done;
}

}  // namespace septet::program

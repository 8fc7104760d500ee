// Files of the programs are their user's alone.
#include "program/run.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <tuple>

#include <doctest/doctest.h>

#include "tests/temporary_folder.hpp"

namespace septet::program {
namespace {
namespace fs = std::filesystem;

unsigned mode_of(const fs::path& path) {
  struct stat found {};
  REQUIRE(::stat(path.c_str(), &found) == 0);
  return found.st_mode & 0777u;
}

/// Runs it as a program would, in a process of its own, whose settings stay there.
int run_as_program(const std::function<int()>& work) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) ::_exit(run("test", [&]() -> Expected<int> { return work(); }));
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("files are 0600 and folders 0700, and the user's umask may only narrow that") {
  for (const auto& [umask, file_mode, folder_mode] : {std::tuple(022u, 0600u, 0700u),
                                                      {0u, 0600u, 0700u},
                                                      {0077u, 0600u, 0700u},
                                                      {0277u, 0400u, 0500u},
                                                      {0007u, 0600u, 0700u}}) {
    const auto asked = umask;
    CAPTURE(asked);
    const TemporaryFolder folder;
    CHECK(run_as_program([&, mask = umask] {
            ::umask(mask);
            return run("inner", [&]() -> Expected<int> {
              std::ofstream(folder / "summary.json") << "P07";
              fs::create_directories(folder / "out");
              return 0;
            });
          }) == 0);
    CHECK(mode_of(folder / "summary.json") == file_mode);
    CHECK(mode_of(folder / "out") == folder_mode);
  }
}

TEST_CASE("a program leaves no core file, nor do its children") {
  CHECK(run_as_program([] {
          rlimit limit{1, 1};
          const int asked = ::getrlimit(RLIMIT_CORE, &limit);
          return asked == 0 && limit.rlim_cur == 0 && limit.rlim_max == 0 ? 7 : 1;
        }) == 7);
  CHECK(run_as_program([] { return std::system("test \"$(ulimit -c)\" = 0") == 0 ? 8 : 1; }) == 8);
}

}  // namespace septet::program

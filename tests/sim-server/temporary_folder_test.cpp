#include "sim-server/temporary_folder.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <optional>

#include <doctest/doctest.h>

#include "tests/temporary_folder.hpp"

namespace septet::server {
namespace fs = std::filesystem;

TEST_CASE("a folder is gone with its run and that of a killed run with the next one and those of others stay") {
  const septet::TemporaryFolder place;
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", place.path().c_str(), 1);
  fs::create_directories(place / "septet-letters");
  fs::create_directories(place / "other-AbCdEf");
  const pid_t child = ::fork();
  if (child == 0) {
    const auto folder = TemporaryFolder::make("septet");
    if (folder) std::ofstream(folder->path() / "secret.key") << "secret";
    ::_exit(folder ? 0 : 1);  // Nobody's destructor runs.
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WEXITSTATUS(status) == 0);
  const auto count = [&] { return std::distance(fs::directory_iterator(place.path()), fs::directory_iterator()); };
  CHECK(count() == 3);
  {
    const auto first = TemporaryFolder::make("septet");
    REQUIRE(first.has_value());
    CHECK(count() == 3);  // The killed run's has made room for it.
    const auto second = TemporaryFolder::make("septet");
    REQUIRE(second.has_value());
    CHECK(fs::exists(first->path()));
    CHECK(count() == 4);
  }
  CHECK(count() == 2);
  CHECK(fs::exists(place / "septet-letters"));
  before ? ::setenv("TMPDIR", kept.c_str(), 1) : ::unsetenv("TMPDIR");
}

}  // namespace septet::server

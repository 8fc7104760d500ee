#include "program/temporary_folder.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>

#include <doctest/doctest.h>

#include "tests/temporary_folder.hpp"

namespace septet::program {
namespace fs = std::filesystem;

namespace {

/// A folder that is the system's for temporary files for a while.
struct Place {
  Place() { ::setenv("TMPDIR", folder.path().c_str(), 1); }
  ~Place() { before ? ::setenv("TMPDIR", before->c_str(), 1) : ::unsetenv("TMPDIR"); }
  auto entries() const { return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()); }

  const char* found = std::getenv("TMPDIR");
  std::optional<std::string> before = found ? std::optional<std::string>(found) : std::nullopt;
  septet::TemporaryFolder folder;
};

}  // namespace

TEST_CASE(
    "a folder is gone with its run and what a killed run has left is gone with the next one and those of others stay") {
  const Place place;
  fs::create_directories(place.folder / "septet-letters.run");
  fs::create_directories(place.folder / "other-AbCdEf");
  fs::create_directories(place.folder / "septet-AbCdEfGhIj");  // As long as an orphan's name.
  fs::create_directories(place.folder / "septet-AbCdEf.run");
  std::ofstream(place.folder / "septet-AbCdEf.run" / "secret.key") << "secret";
  {
    const auto first = TemporaryFolder::make("septet");
    REQUIRE(first.has_value());
    CHECK_FALSE(fs::exists(place.folder / "septet-AbCdEf.run"));
    const auto second = TemporaryFolder::make("septet");
    REQUIRE(second.has_value());
    CHECK(fs::exists(first->path()));
    CHECK(place.entries() == 5);
  }
  CHECK(place.entries() == 3);
  CHECK(fs::exists(place.folder / "septet-letters.run"));
}

TEST_CASE("a folder that no run has made is nobody's orphan however much its name is alike") {
  const Place place;
  const septet::TemporaryFolder of_a_test;
  for (const char* name : {"septet", "septet-test", "septet-sumo"}) {
    CAPTURE(name);
    REQUIRE(TemporaryFolder::make(name).has_value());
    CHECK(fs::exists(of_a_test.path()));
  }
}

TEST_CASE("the folder of a run that is killed is gone with it") {
  const Place place;
  int told[2];
  REQUIRE(::pipe(told) == 0);
  const pid_t run = ::fork();
  if (run == 0) {
    const auto folder = TemporaryFolder::make("septet");
    if (folder) std::ofstream(folder->path() / "secret.key") << "secret";
    if (::write(told[1], folder ? "y" : "n", 1) == 1) ::pause();
    ::_exit(1);
  }
  char made = 'n';
  REQUIRE(::read(told[0], &made, 1) == 1);
  CHECK(made == 'y');
  CHECK(place.entries() == 1);
  ::kill(run, SIGKILL);
  ::waitpid(run, nullptr, 0);
  for (int i = 0; i < 6000 && place.entries() > 0; ++i) ::usleep(10'000);
  CHECK(place.entries() == 0);
  ::close(told[0]);
  ::close(told[1]);
}

}  // namespace septet::program

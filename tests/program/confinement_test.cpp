#include "program/confinement.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <system_error>
#include <vector>

#include <doctest/doctest.h>

#include "tests/temporary_folder.hpp"

namespace septet::program {
namespace {
namespace fs = std::filesystem;

/// In a process of its own, since confinement is permanent; with a temporary folder of its own, which is always
/// writable.
int run_confined(const fs::path& temporary, const std::vector<fs::path>& places, const std::function<int()>& work) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::setenv("TMPDIR", temporary.c_str(), 1);
    ::_exit(write_only_below(places) ? work() : 77);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool writes(const fs::path& path) { return static_cast<bool>(std::ofstream(path) << "x" << std::flush); }

bool reads(const fs::path& path) {
  std::string word;
  return static_cast<bool>(std::ifstream(path) >> word);
}

}  // namespace

TEST_CASE("a confined process reads everything, and writes, makes and removes only where it was told") {
  const TemporaryFolder folder;
  for (const char* name : {"tmp", "out", "own"}) fs::create_directories(folder / name);
  const fs::path own = folder / "own", out = folder / "out", thesis = own / "thesis.txt";
  std::ofstream(thesis) << "years of work";
  const int status = run_confined(folder / "tmp", {out / "made" / "later"}, [&] {
    std::error_code error;
    int wrong = 0;
    const auto expect = [&](bool is_so, int bit) { wrong |= is_so ? 0 : 1 << bit; };
    expect(reads(thesis), 0);
    expect(fs::create_directories(out / "made" / "later", error) && writes(out / "made" / "later" / "report.html"), 1);
    expect(fs::remove(out / "made" / "later" / "report.html", error), 2);
    expect(writes(folder / "tmp" / "copy") && writes("/dev/null"), 3);
    expect(!fs::remove(thesis, error) && !writes(thesis), 4);
    expect(!writes(own / "new") && !fs::create_directory(own / "folder", error), 5);
    fs::rename(thesis, own / "other", error);
    expect(bool(error), 6);
    fs::create_symlink(thesis, own / "link", error);
    expect(bool(error), 7);
    return wrong;
  });
  if (status == 77) {
    MESSAGE("skipped: this kernel has no Landlock");
    return;
  }
  CHECK(status == 0);
  CHECK(fs::file_size(thesis) == 13);
}

TEST_CASE("children of a confined process, and what it starts, are confined as well") {
  const TemporaryFolder folder;
  for (const char* name : {"tmp", "own"}) fs::create_directories(folder / name);
  std::ofstream(folder / "own" / "thesis.txt") << "years of work";
  const std::string remove = "rm -f '" + (folder / "own" / "thesis.txt").string() + "' 2>/dev/null";
  const int status = run_confined(folder / "tmp", {}, [&] { return std::system(remove.c_str()) == 0 ? 1 : 0; });
  CHECK((status == 0 || status == 77));
  if (status == 0) CHECK(fs::exists(folder / "own" / "thesis.txt"));
}

}  // namespace septet::program

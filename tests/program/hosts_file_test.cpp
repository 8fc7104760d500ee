#include "program/hosts_file.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <sys/stat.h>

#include <doctest/doctest.h>

#include "tests/temporary_folder.hpp"

namespace septet::program {
namespace {

Expected<void> check(const TemporaryFolder& folder, const std::string& text) {
  std::ofstream(folder / "hosts", std::ios::binary) << text;
  return check_hosts_file(folder / "hosts");
}

}  // namespace

TEST_CASE("a file of hosts in Open MPI's words is taken") {
  const TemporaryFolder folder;
  for (const char* text :
       {"localhost\n", "pc-2", "# lab\n\n  10.7.0.3 slots=4 max_slots=8 # left\r\nanna@pc_3 slots=1\n",
        "[fe80::1%eth0]\n::1\n"}) {
    const auto checked = check(folder, text);
    CHECK_MESSAGE(checked.has_value(), text);
  }
}

TEST_CASE("nonsense in a file of hosts is one message with the file and the line") {
  const TemporaryFolder folder;
  for (const char* line : {"!!!", "-x", "pc-2 slots", "pc-2 slots=many", "pc-2 pc-3", "pc\x1b[2J", "pc;rm",
                           "pc-2 slots=-1", "slots=3=4"}) {
    const auto checked = check(folder, std::string("localhost\n\n") + line + "\n");
    REQUIRE_MESSAGE(!checked.has_value(), line);
    CHECK(checked.error().where == (folder / "hosts").string() + ":3");
    CHECK(checked.error().what.find('\n') == std::string::npos);
    CHECK(checked.error().what.find('\x1b') == std::string::npos);
  }
  for (const char* nobody : {"", "\n\n", "# nobody\n"}) CHECK_FALSE(check(folder, nobody).has_value());
  CHECK_FALSE(check_hosts_file(folder / "none").has_value());
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK_FALSE(check_hosts_file(folder / "pipe").has_value());
}

}  // namespace septet::program

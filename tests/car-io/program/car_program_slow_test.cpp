#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/checkout.hpp"
#include "tests/temporary_folder.hpp"

namespace {

struct Ended {
  int code = -1;
  std::string output;
};

/// Runs septet-car and takes both outputs together.
Ended septet_car(const std::string& arguments) {
  Ended ended;
  FILE* pipe = ::popen(fmt::format("{}/septet-car {} 2>&1", septet::build_folder(), arguments).c_str(), "r");
  REQUIRE(pipe != nullptr);
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe)) ended.output += buffer;
  const int status = ::pclose(pipe);
  ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return ended;
}

void check_refused(const std::string& arguments, std::initializer_list<const char*> words) {
  const Ended ended = septet_car(arguments);
  INFO(ended.output);
  CHECK(ended.code > 0);
  CHECK(std::ranges::count(ended.output, '\n') == 1);
  for (const char* word : words) {
    CAPTURE(word);
    CHECK(ended.output.find(word) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("a wrong option or rig or device ends septet-car with one message") {
  const septet::TemporaryFolder folder;
  const std::string screen =
      "[[screen]]\nname = \"a\"\nlower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, "
      "0]\nupper_left_m = [2, 1, 1]\n";
  const auto rig = [&](const std::string& car) {
    std::ofstream(folder / "rig.toml") << "name = \"r\"\neye_point_m = [1.35, 0.37, 1.17]\n[car]\n"
                                       << car << "\n"
                                       << screen;
    return "--rig " + (folder / "rig.toml").string();
  };
  check_refused("--bogus", {"--bogus"});
  check_refused("", {"--keys"});
  check_refused("--keys " + folder.path().string(), {"server.public"});
  check_refused("--server nowhere --keys " + folder.path().string(), {"--server"});
  check_refused("calibrate --rig " + (folder / "none.toml").string(), {"none.toml"});
  check_refused("calibrate " + rig("source = 3"), {"rig.toml:4", "car.source"});
  check_refused("calibrate " + rig("source = \"hid\"\nlayout = \"tractor\""), {"tractor", "logitech-g29"});
  check_refused("try --fan 0.5 " + rig("source = \"hid\"\nproduct_id = 0xfffe"), {"1209:fffe", "not plugged in"});
  check_refused("try --fan 1.5 " + rig("source = \"hid\""), {"--fan"});
}

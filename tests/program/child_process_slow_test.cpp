#include "program/child_process.hpp"

#include <thread>

#include <doctest/doctest.h>

namespace septet::program {

using namespace std::chrono_literals;

TEST_CASE("a line that has been said is read however late it is asked for") {
  auto child = ChildProcess::start({.program = "/bin/echo", .arguments = {"ended"}, .environment = {}, .log = {}});
  REQUIRE(child.has_value());
  while (!child->poll()) std::this_thread::sleep_for(1ms);
  // As if the caller had to wait for a processor until the time is up.
  CHECK(child->read_line(-5ms) == "ended");
  CHECK_FALSE(child->read_line(-5ms).has_value());
}

}  // namespace septet::program

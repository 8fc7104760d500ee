#include "program/process_mark.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <doctest/doctest.h>

namespace septet::program {

TEST_CASE("a process is there until it has ended and of another machine nothing is known") {
  const ProcessMark own = own_process_mark();
  CHECK(own.number == ::getpid());
  REQUIRE_FALSE(own.machine.empty());
  CHECK(is_there(own) == true);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) ::_exit(0);
  REQUIRE(::waitpid(child, nullptr, 0) == child);
  CHECK(is_there({own.machine, child}) == false);
  CHECK_FALSE(is_there({"another", own.number}).has_value());
  // Numbers that would mean groups of processes, from bytes of another program.
  CHECK_FALSE(is_there({own.machine, 0}).has_value());
  CHECK_FALSE(is_there({own.machine, -1}).has_value());
  CHECK_FALSE(is_there({}).has_value());
}

}  // namespace septet::program

#include "program/stop_signal.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include <doctest/doctest.h>

namespace septet::program {
namespace {

constexpr int still_threatened = 200;  ///< An exit status that is no signal.

/// Exit status, or minus the signal, of a process that does `what` and is sent `signal` once it is ready.
template <class What>
int end_of(int signal, unsigned patience_s, What what) {
  int ready[2];
  REQUIRE(::pipe(ready) == 0);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    catch_stop_signals(patience_s);
    (void)!::write(ready[1], "r", 1);
    ::_exit(what());
  }
  char byte;
  REQUIRE(::read(ready[0], &byte, 1) == 1);
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(ready[0]);
  ::close(ready[1]);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

TEST_CASE("a program that looks ends as it likes and knows which signal it was") {
  std::signal(SIGHUP, SIG_DFL);  // Also where the tests run under nohup.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
    CAPTURE(signal);
    CHECK(end_of(signal, 3600, [] {
            while (!stop_signal()) ::usleep(1000);
            obey_stop_signal();
            // An end under way is not cut off: the alarm is off.
            return ::alarm(0) == 0 ? *stop_signal() : still_threatened;
          }) == signal);
  }
}

TEST_CASE("a program that is stuck is ended after its patience") {
  CHECK(end_of(SIGTERM, 1, [] {
          for (volatile bool stuck = true; stuck;) {
          }
          return 0;
        }) == -SIGALRM);
}

TEST_CASE("of several signals the first is the one that stopped it and a terminal's end is none where it was ignored") {
  CHECK(end_of(SIGUSR1, 3600, [] {
          while (!stop_signal()) ::usleep(1000);
          ::raise(SIGTERM);
          return *stop_signal();
        }) == SIGUSR1);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    std::signal(SIGHUP, SIG_IGN);  // As nohup leaves it.
    catch_stop_signals(3600);
    ::raise(SIGHUP);
    ::_exit(stop_signal() ? 1 : 0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

}  // namespace septet::program

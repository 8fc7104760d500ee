#include "program/console.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <memory>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "program/run.hpp"

namespace septet::program {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// A file in place of a terminal.
struct Console {
  std::unique_ptr<std::FILE, Close> file{std::tmpfile()};
  std::string text() const {
    std::string all(4096, '\0');
    std::rewind(file.get());
    all.resize(std::fread(all.data(), 1, all.size(), file.get()));
    return all;
  }
};

/// Exit status of a process that does `what` with `name` as its standard error.
template <class What>
int status_with_error_to(const char* name, What what) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const int file = ::open(name, O_WRONLY);
    if (file < 0 || ::dup2(file, STDERR_FILENO) < 0) ::_exit(99);
    ::_exit(what());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

TEST_CASE("progress is one line on a terminal and a line every ten seconds elsewhere") {
  const Console screen, log;
  ProgressLine on_terminal(screen.file.get(), true), in_log(log.file.get(), false);
  for (ProgressLine* progress : {&on_terminal, &in_log}) {
    for (const double now_s : {0.0, 0.05, 0.15, 9.9, 10.1})
      if (progress->is_due(now_s)) progress->show(std::to_string(now_s).substr(0, 4));
    progress->message("a screen has come");
    // The clock restarts.
    if (progress->is_due(0.0)) progress->show("anew");
    progress->close();
    progress->close();
  }
  CHECK(screen.text() == "\r\033[K0.00\r\033[K0.15\r\033[K9.90\r\033[K10.1\na screen has come\n\r\033[Kanew\n");
  CHECK(log.text() == "0.00\n10.1\na screen has come\nanew\n");
}

TEST_CASE("a full disk under standard error ends no program") {
  CHECK(status_with_error_to("/dev/full", [] {
          say("nobody reads this");
          return 7;
        }) == 7);
}

TEST_CASE("an error and an exception are exit status 1 and what the work returns is the exit status otherwise") {
  CHECK(status_with_error_to("/dev/null", [] {
          return run("p", []() -> Expected<int> { return failure("wrong", "here", ""); });
        }) == failed_status);
  CHECK(status_with_error_to("/dev/null", [] {
          return run("p", []() -> Expected<int> { throw std::runtime_error("a library's"); });
        }) == failed_status);
  CHECK(run("p", []() -> Expected<int> { return 3; }) == 3);
}

TEST_CASE("a reader that has heard enough makes no failure of what was said to it and a full disk does") {
  const auto status_with_output_to = [](int file) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      ::dup2(file, STDOUT_FILENO);
      std::fclose(stderr);
      ::_exit(run("p", []() -> Expected<int> {
        std::fputs("a line\n", stdout);
        return 0;
      }));
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  ::close(ends[0]);
  CHECK(status_with_output_to(ends[1]) == 0);
  ::close(ends[1]);
  const int full = ::open("/dev/full", O_WRONLY);
  REQUIRE(full >= 0);
  CHECK(status_with_output_to(full) == failed_status);
  ::close(full);
}

}  // namespace septet::program

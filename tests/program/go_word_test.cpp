#include "program/go_word.hpp"

#include <unistd.h>

#include <string_view>

#include <doctest/doctest.h>

namespace septet::program {
namespace {

/// Standard input that a test writes.
struct Input {
  Input() {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    ::dup2(ends[0], STDIN_FILENO);
    ::close(ends[0]);
    to = ends[1];
  }
  ~Input() {
    if (to >= 0) ::close(to);
    ::dup2(before, STDIN_FILENO);
    ::close(before);
  }
  void say(std::string_view text) const {
    REQUIRE(::write(to, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
  }
  int before = ::dup(STDIN_FILENO), to = -1;
};

}  // namespace

TEST_CASE("each rearm is said once, also behind the word go") {
  const Input input;
  GoWord word;
  CHECK_FALSE(word.take_rearm());
  input.say("\nrearm\nrear\n");
  CHECK(word.said());
  CHECK(word.take_rearm());
  CHECK_FALSE(word.take_rearm());
}

TEST_CASE("go or an empty line is the word and nothing else is, in however many pieces it comes") {
  const Input input;
  GoWord word;
  CHECK_FALSE(word.said());
  input.say("stop\ngone\n g");
  CHECK_FALSE(word.said());
  input.say("o\n");  // After a blank: another word.
  CHECK_FALSE(word.said());
  input.say("g");
  CHECK_FALSE(word.said());
  input.say("o\nstop\n");
  CHECK(word.said());
  CHECK(word.said());
  GoWord other;
  input.say("\n");
  CHECK(other.said());
}

TEST_CASE("who closes standard input has not said the word") {
  Input input;
  GoWord word;
  ::close(input.to);
  input.to = -1;
  CHECK_FALSE(word.said());
  CHECK_FALSE(word.said());
}

}  // namespace septet::program

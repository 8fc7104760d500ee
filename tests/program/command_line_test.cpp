#include "program/command_line.hpp"

#include <doctest/doctest.h>

using namespace septet::program;

TEST_CASE("an option's number lies within its bounds, and nan does not") {
  const CLI::Validator between = number_between(0.0, 1e6);
  for (const char* good : {"0", "0.5", "1e6", "-0"}) CHECK(between(good).empty());
  for (const char* bad : {"nan", "NaN", "-nan", "inf", "-1", "1000001", "1e7", "0,5", "1 s", ""}) {
    CAPTURE(bad);
    CHECK(!between(bad).empty());
  }
}

TEST_CASE("a seed is a whole number of 64 bits without a sign") {
  for (const char* good : {"0", "7", "18446744073709551615"}) CHECK(seed_number()(good).empty());
  for (const char* bad : {"-1", "+1", "18446744073709551616", "99999999999999999999999", "1e3", "0x10", "", " 1"}) {
    CAPTURE(bad);
    CHECK(!seed_number()(bad).empty());
  }
}

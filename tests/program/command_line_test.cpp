#include "program/command_line.hpp"

#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

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

TEST_CASE("a word of the command line that is empty is wrong use of the option that it follows, and a flag has none") {
  const auto status_of = [](const std::vector<std::string>& words) {
    CLI::App app;
    std::string folder, name;
    bool loud = false;
    app.add_option("--out", folder);
    app.add_flag("--loud", loud);
    app.add_subcommand("go")->add_option("name", name);
    const auto parse = [&] { app.parse(std::vector<std::string>(words.rbegin(), words.rend())); };
    return run("test", app, parse, [] { return 0; });
  };
  for (const auto& good : std::vector<std::vector<std::string>>{
           {}, {"--out", "a"}, {"--loud"}, {"--out", "a", "--loud", "go", "b"}, {"go"}}) {
    CAPTURE(fmt::format("{}", fmt::join(good, " ")));
    CHECK(status_of(good) == 0);
  }
  for (const auto& bad : std::vector<std::vector<std::string>>{
           {"--out", ""}, {"--out="}, {"go", ""}, {"--loud", "go", "b", "--out", ""}}) {
    CAPTURE(fmt::format("{}", fmt::join(bad, " ")));
    CHECK(status_of(bad) == wrong_use_status);
  }
}

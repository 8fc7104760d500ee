#include "command-line/command/vehicle_command.hpp"

#include <filesystem>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include "program/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::server {

TEST_CASE("the manoeuvre asked for is driven and no other, and one that is not known is refused") {
  const auto folder = program::TemporaryFolder::make("septet-track").value();
  const auto file_of = [&](std::string_view manoeuvre) {
    return folder.path() / ("volvo-s80-" + std::string(manoeuvre) + ".json");
  };
  const auto one = run_vehicle_test({.manoeuvre = "stop", .out = folder.path()});
  REQUIRE_MESSAGE(one.has_value(), why_not(one));
  CHECK(*one == 0);
  for (const std::string_view name : vehicle::manoeuvre_names())
    CHECK(std::filesystem::exists(file_of(name)) == (name == "stop"));
  CHECK_FALSE(run_vehicle_test({.manoeuvre = "somersault"}).has_value());
}

TEST_CASE("a manoeuvre without a valid result is exit status 2") {
  CHECK(run_vehicle_test({.manoeuvre = "step-steer", .amplitude_deg = 1400.0}) == 2);
}

}  // namespace septet::server

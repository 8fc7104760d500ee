#include "command-line/command/input_table.hpp"

#include <doctest/doctest.h>

namespace septet::server {
namespace {

std::string error_of(std::string_view text) {
  const auto rows = read_input_table(text, "in.csv");
  REQUIRE(!rows.has_value());
  return describe(rows.error());
}

}  // namespace

TEST_CASE("a table of inputs names its columns in any order") {
  const auto rows =
      read_input_table("# a lane change\nbrake, time_s ,steering_wheel_deg\r\n0,0,0\n\n0.5,1.5,-90\n", "in.csv");
  REQUIRE(rows.has_value());
  REQUIRE(rows->size() == 2);
  CHECK((*rows)[1].time_s == 1.5);
  CHECK((*rows)[1].input.brake == 0.5);
  CHECK((*rows)[1].input.steering_wheel_rad == doctest::Approx(-1.5707963));
  CHECK((*rows)[1].input.selector == GearSelector::drive);
  const auto manual = read_input_table("time_s,gear\n0,1\n1,-1\n", "in.csv");
  REQUIRE(manual.has_value());
  CHECK((*manual)[1].input.selector == GearSelector::manual);
  CHECK((*manual)[1].input.gear == -1);
}

TEST_CASE("a table that is wrong is told where and what to write") {
  CHECK(error_of("").find("fewer than two rows") != std::string::npos);
  CHECK(error_of("time_s,speed\n").find("\"speed\" is no column") != std::string::npos);
  CHECK(error_of("brake\n0\n1\n").find("no column time_s") != std::string::npos);
  CHECK(error_of("time_s,brake\n0,0\n1\n").find("in.csv:3") != std::string::npos);
  CHECK(error_of("time_s,brake\n0,0\n1,1.5\n").find("from 0 to 1") != std::string::npos);
  CHECK(error_of("time_s,brake\n0,0\n1,nan\n").find("brake is \"nan\"") != std::string::npos);
  CHECK(error_of("time_s\n0\n0\n").find("ascending") != std::string::npos);
  CHECK(error_of("time_s\n0\n1x\n").find("time_s is \"1x\"") != std::string::npos);
}

}  // namespace septet::server

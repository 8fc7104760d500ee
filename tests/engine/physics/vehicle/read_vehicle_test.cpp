#include <doctest/doctest.h>

#include "tests/engine/physics/vehicle/car.hpp"

using namespace septet;
using namespace septet::vehicle;

namespace {
std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), with);
}
}  // namespace

TEST_CASE("every number of a vehicle needs a source") {
  const std::string text =
      replaced(vehicle_text("volvo-s80"),
               "value = 2.791, source = \"sourced: theautochannel.com 1999\"", "value = 2.791");
  const auto car = read_vehicle(text, "volvo-s80");
  REQUIRE(!car);
  CHECK(car.error().what == "has no source");
  CHECK(car.error().where == "volvo-s80, body.wheelbase_m");
}

TEST_CASE("a misspelt entry of a vehicle is named") {
  const auto car = read_vehicle(replaced(vehicle_text("volvo-s80"), "track_m", "trak_m"), "v");
  REQUIRE(!car);
  CHECK(car.error().where == "v, suspension.front.track_m");
  const auto extra = read_vehicle(
      vehicle_text("volvo-s80") + "\nlag_ms = { value = 1, source = \"assumed: nothing\" }\n", "v");
  REQUIRE(!extra);
  CHECK(extra.error().what == "is not known");
}

TEST_CASE("values out of bounds and broken tables are refused") {
  CHECK(!read_vehicle(replaced(vehicle_text("volvo-s80"), "value = 1752", "value = 17520"), "v"));
  CHECK(!read_vehicle(replaced(vehicle_text("volvo-s80"), "value = 1752", "value = nan"), "v"));
  CHECK(
      !read_vehicle(replaced(vehicle_text("volvo-s80"), "x = [0, 80, 157", "x = [0, 0, 157"), "v"));
  CHECK(!read_vehicle(replaced(vehicle_text("volvo-s80"), "x = [0, 80, 157", "x = [80, 157"), "v"));
  CHECK(!read_vehicle("[body", "v"));
}

TEST_CASE("points of a table out of any car's range are refused with their place") {
  const auto error_of = [](const std::string& what, const std::string& with) {
    const auto car = read_vehicle(replaced(vehicle_text("volvo-s80"), what, with), "v");
    return car ? std::string() : describe(car.error());
  };
  CHECK(error_of("225, 255, 272", "225, 1e308, 272").find("powertrain.full_torque_nm: is 1e+308 at point 4, outside 0 to 5000") !=
        std::string::npos);
  CHECK(error_of("y = [-5900, ", "y = [-1e12, ").find("suspension.front.spring_force_n") != std::string::npos);
  CHECK(error_of("366, 440, 524, 628, 680", "366, 440, 524, 628, 1e12").find("x is") != std::string::npos);
  CHECK(error_of("y = [2.92, 1.57", "y = [2.92, 0").find("powertrain.gear_ratios") != std::string::npos);
}

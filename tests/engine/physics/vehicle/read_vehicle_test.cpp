#include <algorithm>

#include <doctest/doctest.h>

#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/why_not.hpp"

using namespace septet;
using namespace septet::vehicle;

namespace {
std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), with);
}

/// "NAME:LINE:COLUMN" of the place after `words`, or `behind` characters after their beginning.
std::string place(const std::string& text, const std::string& name, const std::string& words,
                  std::size_t behind = std::string::npos) {
  const auto at = text.find(words);
  REQUIRE(at != std::string::npos);
  const auto line_begin = text.rfind('\n', at) + 1;
  const auto column = at - line_begin + 1 + (behind == std::string::npos ? words.size() : behind);
  return name + ":" +
         std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')) + ":" +
         std::to_string(column);
}
}  // namespace

TEST_CASE("every number of a vehicle needs a source") {
  const std::string text = replaced(vehicle_text("volvo-s80"),
                                    "value = 2.791, source = \"sourced: theautochannel.com 1999\"", "value = 2.791");
  const auto car = read_vehicle(text, "volvo-s80");
  REQUIRE(!car);
  CHECK(car.error().what == "has no source");
  CHECK(car.error().where == place(text, "volvo-s80", "wheelbase_m = ") + ", body.wheelbase_m");
}

TEST_CASE("a misspelt entry of a vehicle is named and a missing one with the table that lacks it") {
  const std::string text = replaced(vehicle_text("volvo-s80"), "track_m", "trak_m");
  const auto car = read_vehicle(text, "v");
  REQUIRE(!car);
  CHECK(car.error().what == "is missing");
  CHECK(car.error().where == place(text, "v", "[suspension.front]", 0) + ", suspension.front.track_m");
  const std::string longer = vehicle_text("volvo-s80") + "\nlag_ms = { value = 1, source = \"assumed: nothing\" }\n";
  const auto extra = read_vehicle(longer, "v");
  REQUIRE(!extra);
  CHECK(extra.error().what == "is not known");
  CHECK(extra.error().where.starts_with(place(longer, "v", "lag_ms = ") + ", "));
}

TEST_CASE("values out of bounds and broken tables are refused") {
  CHECK(!read_vehicle(replaced(vehicle_text("volvo-s80"), "value = 1752", "value = 17520"), "v"));
  CHECK(!read_vehicle(replaced(vehicle_text("volvo-s80"), "value = 1752", "value = nan"), "v"));
  CHECK(!read_vehicle(replaced(vehicle_text("volvo-s80"), "x = [0, 80, 157", "x = [0, 0, 157"), "v"));
  CHECK(!read_vehicle(replaced(vehicle_text("volvo-s80"), "x = [0, 80, 157", "x = [80, 157"), "v"));
  CHECK(!read_vehicle("[body", "v"));
}

TEST_CASE("points of a table out of any car's range are refused with their place") {
  const auto error_of = [](const std::string& what, const std::string& with) {
    const auto car = read_vehicle(replaced(vehicle_text("volvo-s80"), what, with), "v");
    return why_not(car);
  };
  CHECK(error_of("225, 255, 272", "225, 1e308, 272")
            .find("powertrain.full_torque_nm: is 1e+308 at point 4, outside 0 to 5000") != std::string::npos);
  CHECK(error_of("y = [-5900, ", "y = [-1e12, ").find("suspension.front.spring_force_n") != std::string::npos);
  CHECK(error_of("366, 440, 524, 628, 680", "366, 440, 524, 628, 1e12").find("x is") != std::string::npos);
  CHECK(error_of("y = [2.92, 1.57", "y = [2.92, 0").find("powertrain.gear_ratios") != std::string::npos);
}

#include "engine/document/table_line.hpp"

#include <doctest/doctest.h>

namespace septet::document {

TEST_CASE("the cells of a line are what lies between its commas without blanks and marks") {
  using Cells = std::vector<std::string_view>;
  CHECK(cells_of("\xEF\xBB\xBFtime_s, brake\t,,x y \r") == Cells{"time_s", "brake", "", "x y"});
  CHECK(cells_of("") == Cells{""});
  CHECK(cells_of(",") == Cells{"", ""});
}

TEST_CASE("a cell is a number only as a whole") {
  CHECK(number_in<double>("-1.5e3") == -1500.0);
  CHECK(number_in<int>("-4") == -4);
  for (const char* none : {"", "1,", "1 ", " 1", "one", "1.5x"}) CHECK_FALSE(number_in<double>(none).has_value());
  CHECK_FALSE(number_in<int>("1.5").has_value());
}

}  // namespace septet::document

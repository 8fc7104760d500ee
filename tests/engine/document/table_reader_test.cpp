#include "engine/document/table_reader.hpp"

#include <doctest/doctest.h>
#include <toml++/toml.h>

#include "engine/document/toml_table.hpp"

using namespace septet;
using namespace septet::document;

TEST_CASE("the bounds of a range belong to it and what lies beyond is refused with its place") {
  for (const std::string text : {"x = 2.0", "x = 5.0", "x = 1.999", "x = 5.001", "x = nan"}) {
    CAPTURE(text);
    const bool good = text.ends_with(".0");
    const auto table = parse_toml(text, "a.toml");
    REQUIRE(table);
    Error error;
    TableReader reader(*table, "a.toml", "a", error);
    reader.get_double("x", 3.0, 2.0, 5.0);
    CHECK(error.what.empty() == good);
    CHECK((good || error.where == "a.toml:1:5"));
  }
}

TEST_CASE("of several things that are wrong in a file the first is told") {
  const auto table = parse_toml("x = 9\ny = 9\nz = 1\n", "a.toml");
  REQUIRE(table);
  Error error;
  TableReader reader(*table, "a.toml", "a", error);
  reader.get_integer("x", 0, 0, 5);
  reader.get_integer("y", 0, 0, 5);
  reader.finish("a text");
  CHECK(error.what == "a.x is out of range");
  CHECK(error.where == "a.toml:1:5");
}

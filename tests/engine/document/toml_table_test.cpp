#include "engine/document/toml_table.hpp"

#include <doctest/doctest.h>
#include <toml++/toml.h>

#include "tests/why_not.hpp"

using namespace septet;
using namespace septet::document;

namespace {
/// "a.a.a…" of so many parts.
std::string dotted(std::size_t parts) {
  std::string key = "a";
  for (std::size_t i = 1; i < parts; ++i) key += i % 3 ? ".a" : " . \"a\"";
  return key;
}
}  // namespace

TEST_CASE("a key of too many parts is refused with its line and whatever it is good for") {
  for (const std::string& text :
       {dotted(100'000) + " = 1\n", "[" + dotted(100'000) + "]\n", "[[" + dotted(100'000) + "]]\n",
        "x = { " + dotted(100'000) + " = 1 }\n", dotted(17) + " = 1\n"}) {
    const auto table = parse_toml("# line 1\n" + text, "hostile.toml");
    REQUIRE_FALSE(table.has_value());
    CHECK(table.error().where.starts_with("hostile.toml:2:"));
    CHECK(table.error().what == "a key has more than 16 parts");
  }
}

TEST_CASE("what only looks like a key of many parts is read") {
  const std::string many = dotted(100);
  const auto table =
      parse_toml("# " + many + "\ntext = '" + dotted(20) +
                     "'\nwords = \"a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a\\\"a.a.\"\n" + "long = '''\n" + many +
                     "'''\n" + dotted(16) + " = 1\nnumbers = [1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 10.5, " +
                     "11.5, 12.5, 13.5, 14.5, 15.5, 16.5, 17.5, 18.5]\n",
                 "good.toml");
  REQUIRE_MESSAGE(table.has_value(), why_not(table));
  CHECK(table->size() == 5);
  CHECK((*table)["numbers"].as_array()->size() == 18);
}

TEST_CASE("the place of a key of too many parts is that of its first part too many") {
  const auto table = parse_toml("# line 1\n  a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q = 1\n", "hostile.toml");
  REQUIRE_FALSE(table.has_value());
  CHECK(table.error().where == "hostile.toml:2:34");
}

TEST_CASE("a table whose name does not begin as a key does is refused with its place") {
  for (const std::string text :
       {"[%shot]", "[ +x]", "[[%shot]]", "[ \t[", "[\xc3\xa4]", "[.a]", "[#", "[\n]", "[[", "[=", "  [,]"}) {
    CAPTURE(text);
    const auto table = parse_toml("a = 1\n" + text + "\n", "hostile.toml");
    REQUIRE_FALSE(table.has_value());
    CHECK(table.error().where.starts_with("hostile.toml:"));
  }
  const auto table = parse_toml("a = 1\n  [[%shot]]\n", "hostile.toml");
  REQUIRE_FALSE(table.has_value());
  CHECK(table.error().where == "hostile.toml:2:3");
  CHECK(table.error().what == "the name of a table does not begin as a key does");
  CHECK_FALSE(parse_toml("\xef\xbb\xbf[%shot]\n", "hostile.toml").has_value());
}

TEST_CASE("arrays over many lines are not taken for names of tables") {
  const auto table = parse_toml(
      "a = [\n[+1, 2],\n  [\n[+3], {b = [\n[+4]]}]]\n[\"b\"]\n['c']\n[-]\n[ d ]\nx = [\n{y = 1},\n{y = 2}\n]\n[[e]]\n",
      "good.toml");
  REQUIRE_MESSAGE(table.has_value(), why_not(table));
  CHECK(table->size() == 6);
}

TEST_CASE("text that is no TOML is refused with its line and column") {
  const auto table = parse_toml("a = 1\nb = \n", "broken.toml");
  REQUIRE_FALSE(table.has_value());
  CHECK(table.error().where == "broken.toml:2:5");
  for (const std::string text : {"\"", "a = \"\\", "a = '''", "'''''", "\\", "a = \"\"\""})
    CHECK_FALSE(parse_toml(text, "x").has_value());
}

TEST_CASE("the keys at the top say what a file describes") {
  const auto keys = top_keys_of_toml("name = 'x'\n[body]\nmass = 1\n[[shot]]\n", "x.toml");
  REQUIRE(keys.has_value());
  CHECK(*keys == std::vector<std::string>{"body", "name", "shot"});
}

TEST_CASE("a text that is too long for TOML is refused before it is read") {
  const auto table = parse_toml("name = \"" + std::string(2'000'000, 'a') + "\"\n", "hostile.toml");
  REQUIRE(!table.has_value());
  CHECK(describe(table.error()).find("hostile.toml: is 2000010 bytes long") != std::string::npos);
  CHECK(parse_toml("name = \"" + std::string(1'000'000, 'a') + "\"\n", "long.toml").has_value());
}

#include "engine/world/call.hpp"

#include <string>

#include <doctest/doctest.h>

namespace septet {
namespace {

Call read_back(const Call& call) {
  const auto read = read_call(text_of(call));
  REQUIRE_MESSAGE(read.has_value(), text_of(call));
  return *read;
}

}  // namespace

TEST_CASE("a call comes back from its text with blanks, equals signs and empty values in it") {
  for (const Call& call : {Call{.name = "lift"}, Call{.name = "lift-2_B", .node = "tree/412.5/-81.0", .by = "lab"},
                           Call{.name = "say",
                           .node = "town house/1/2",
                           .parameters = {{"words", "a = b, please wait"},
                                          {"empty", ""},
                                          {"x_m", "1=2"},
                                          {"umlaut", "äöå"},
                                          {"sign", "hide \"a b\" \\ \""},
                                          {"path", "a\\b"}},
                           .by = "Anna Berg"}})
    CHECK(read_back(call) == call);
  CHECK(text_of(Call{.name = "lift", .node = "a b", .parameters = {{"s", "3"}}, .by = "lab"}) ==
        "name=lift node=\"a b\" s=3 by=lab");
}

TEST_CASE("what is no call is refused with one reason") {
  for (const char* text : {"",
                           "lift",
                           "name=",
                           "name=\"\"",
                           "name=a b",
                           "name=a.b",
                           "node=x",
                           "name=a name=b",
                           "name=a node=\"\"",
                           "name=a k",
                           "name=a k=",
                           "name=a k=1 k=2",
                           "name=a K=1",
                           "name=a k=\"x",
                           "name=a k=\"x\"y",
                           "name=a  k=1",
                           "name=a ",
                           "name=a k=1\n",
                           "name=a k=\x1b",
                           "name=a k=x\"y",
                           "name=a =1",
                           "name=a by=x by=y"})
    CHECK_MESSAGE(!read_call(text).has_value(), text);
  const std::string long_name(longest_call_name + 1, 'a'), long_value(longest_call_value + 1, 'v');
  CHECK_FALSE(read_call("name=" + long_name).has_value());
  CHECK_FALSE(read_call("name=a k=" + long_value).has_value());
  std::string many = "name=a";
  for (std::size_t i = 0; i <= most_call_parameters; ++i) many += " k" + std::to_string(i) + "=1";
  CHECK_FALSE(read_call(many).has_value());
  CHECK(read_call(many.substr(0, many.rfind(' '))).has_value());
  // Escaped, each value is twice as long.
  Call call{.name = "a"};
  while (call.parameters.size() < most_call_parameters)
    call.parameters.emplace_back("k" + std::to_string(call.parameters.size()), std::string(longest_call_value, '"'));
  CHECK_FALSE(read_call(text_of(call)).has_value());
}

}  // namespace septet

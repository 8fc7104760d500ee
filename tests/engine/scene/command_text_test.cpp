#include "engine/scene/command_text.hpp"

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/scene/builder.hpp"
#include "tests/engine/scene/sample_commands.hpp"

namespace septet::scene {
namespace {

Expected<Command> read(const TextNames& names, std::string_view line) {
  const auto words = words_of(line);
  if (!words) return tl::unexpected(words.error());
  return command_from_words(*words, names);
}

}  // namespace

TEST_CASE("every kind of command is read back from its line as it was") {
  Store store;
  const TextNames names{store, 0};
  for (const Command& command : sample_commands()) {
    const std::string line = to_text(command, names);
    CAPTURE(line);
    CHECK(line.find('\n') == std::string::npos);
    const auto back = read(names, line);
    REQUIRE(back.has_value());
    CHECK(*back == command);
  }
}

TEST_CASE("nodes are meant by name, by type and name, by an id of one's own and by number") {
  Store store;
  SceneBuilder build(store);
  const NodeId tree = build.add_object("tree/1.0/2.0", {}), odd = build.add_object("#7 \"odd\"", {}),
               picture = build.add_bitmap("sign", 1, 1, std::vector<std::uint8_t>(4)),
               sign = build.add_object("sign", {});
  const TextNames names{store, 1000};
  CHECK(to_text(HideSet{tree, true}, names) == "hide-set tree/1.0/2.0 1");
  CHECK(to_text(NodeDestroy{1003}, names) == "node-destroy +3");
  CHECK(to_text(NodeDestroy{picture}, names) == "node-destroy bitmap:sign");
  CHECK(to_text(NodeDestroy{999}, names) == "node-destroy #999");
  for (const NodeId id : {tree, odd, picture, sign, NodeId{1003}, NodeId{999}}) {
    const auto back = read(names, to_text(NodeDestroy{id}, names));
    REQUIRE(back.has_value());
    CHECK(*back == Command(NodeDestroy{id}));
  }
  CHECK(*read(names, "transform-set +0 1 2.5 -3") == Command(TransformSet{1000, {{1.0, 2.5, -3.0}}}));
  CHECK(*read(names, "transform-set +0 1 2 3 2 2 2") ==
        Command(TransformSet{1000, {{1, 2, 3}, {1, 0, 0, 0}, {2, 2, 2}}}));
}

TEST_CASE("a line that is no command names the word that is wrong") {
  Store store;
  const TextNames names{store, 1000};
  const auto why = [&](const char* line) {
    const auto command = read(names, line);
    return command ? std::string() : command.error().what;
  };
  CHECK(why("hide-set tree 1").find("word 2, \"tree\", is not a node that exists") != std::string::npos);
  CHECK(why("hide-set +0") == "the line ends where 0 or 1 is expected");
  CHECK(why("hide-set +0 yes") == "word 3, \"yes\", is not 0 or 1");
  CHECK(why("hide-set +0 1 1").find("word 4") != std::string::npos);
  CHECK(why("hidden +0 1").find("word 1") != std::string::npos);
  CHECK(why("transform-set +0 1 2 nan").find("is no number") != std::string::npos);
  CHECK(why("vertices-set +0 0 4000000000").find("count of what follows") != std::string::npos);
  CHECK(why("node-name-set +0 \"a") == "a text without its end");
  CHECK(why("node-name-set +0 \"\\q\"") == "an unknown escape");
  CHECK(why("crease-set +0 9 a 1").find("number of a kind") != std::string::npos);
  CHECK(why("tag-set +0 0 0 a bytes x123").find("hexadecimal") != std::string::npos);
  CHECK(why("tag-set +0 0 0 a bytes xzz").find("hexadecimal") != std::string::npos);
  CHECK(why("node-destroy +4294967295").find("word 2") != std::string::npos);
  CHECK_FALSE(read(names, "").has_value());
}

}  // namespace septet::scene

#include "engine/scene/edit_file.hpp"

#include <string>

#include <doctest/doctest.h>

#include "engine/scene/builder.hpp"
#include "engine/scene/difference.hpp"
#include "tests/engine/scene/sample_commands.hpp"

namespace septet::scene {
namespace {

/// A small generated world; another order of generation gives other ids.
Store world(bool other_order) {
  Store store;
  SceneBuilder build(store);
  if (other_order) build.add_object("bush/9.0/9.0", {});
  build.add_object("tree/1.0/2.0", {.parent_from_object = {{1, 2, 0}, {1, 0, 0, 0}}});
  build.add_object("sign/3.0/4.0", {});
  build.add_bitmap("face", 16, 8, std::vector<std::uint8_t>(16 * 8 * 4, 200));
  build.add_material("paint", {});
  return store;
}

NodeId object(const Store& store, const char* name) {
  const Node* node = store.find(NodeType::object, name);
  REQUIRE(node != nullptr);
  return node->id;
}

}  // namespace

TEST_CASE("what differs turns one world into the other, whatever was done") {
  Store before, after;
  for (const Command& command : sample_commands())
    if (command.index() > 2) REQUIRE(before.apply(command).has_value());
  after = before;
  for (const Command& command : std::vector<Command>{
           HideSet{1, true}, NodeNameSet{1, "other"}, TagGroupDestroy{1, 0}, GeometrySizeSet{2, 3, 1}, NodeDestroy{4},
           BitmapSizeSet{6, 8, 8, 1}, NodeCreate{77, NodeType::material}, FragmentDestroy{3, 0}})
    (void)after.apply(command);
  for (const auto& [from, to] : {std::pair(&before, &after), std::pair(&after, &before)}) {
    Store turned = *from;
    describe_difference(*from, *to, [&](const Command& command) {
      CAPTURE(name_of(command));
      CHECK(turned.apply(command).has_value());
    });
    CHECK(same_content(turned, *to));
  }
}

TEST_CASE("edits that were saved do the same to the world when it is generated with other ids") {
  const Store before = world(false);
  Store after = before;
  REQUIRE(apply_edits(after,
                      "# a ball, a tree away, a sign moved and renamed\n"
                      "node-create +0 object\nnode-name-set +0 stimuli/ball\ntransform-set stimuli/ball 7 8 9\n"
                      "link-set +0 0 child sign/3.0/4.0 0\nhide-set tree/1.0/2.0 1\n"
                      "node-name-set sign/3.0/4.0 \"sign of mine\"\ntransform-set \"sign of mine\" 5 5 5\n",
                      "edits")
              .has_value());
  const std::string saved = edits_between(before, after);
  Store again = world(true);
  REQUIRE(apply_edits(again, saved, "saved").has_value());
  CHECK(std::get<ObjectData>(again.find(object(again, "tree/1.0/2.0"))->data).hidden);
  const auto& ball = std::get<ObjectData>(again.find(object(again, "stimuli/ball"))->data);
  CHECK(ball.transform.position_m == Vec3(7, 8, 9));
  CHECK(ball.links.at(0).target == object(again, "sign of mine"));
  CHECK(std::get<ObjectData>(again.find(object(again, "sign of mine"))->data).transform.position_m == Vec3(5, 5, 5));
  CHECK(edits_between(world(true), again) == saved);
}

TEST_CASE("a line that cannot be done is named with its file and number") {
  Store store = world(false);
  const auto done = apply_edits(store, "hide-set tree/1.0/2.0 1\n\nhide-set tree/1.0/3.0 1\n", "my.edits");
  REQUIRE_FALSE(done.has_value());
  CHECK(done.error().where == "my.edits:3");
  CHECK(done.error().what.find("tree/1.0/3.0") != std::string::npos);
}

TEST_CASE("rubbish in a file of edits comes back printable") {
  Store store;
  const auto done = apply_edits(store, "\x1b[31m\x80 1\n", "my.edits");
  REQUIRE_FALSE(done);
  CHECK(done.error().what.find("\\x1b[31m\\x80") != std::string::npos);
}

}  // namespace septet::scene

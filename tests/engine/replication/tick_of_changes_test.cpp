#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/command_codec.hpp"
#include "tests/engine/replication/whole_things.hpp"
#include "tests/engine/replication/wire.hpp"

namespace septet::replication {

using namespace scene;

namespace {

void change(Wire& wire, const Command& command, std::uint64_t tick) {
  REQUIRE(wire.store.apply(command).has_value());
  wire.server->applied(command, tick);
}

/// Things are made at random ticks, and shown when their tick is due, whatever has come of the scene: the lane repeats what
/// was lost, and all behind it waits. With `cuts` connections end at any message, and come again later.
void watch_things(std::uint64_t seed, bool cuts) {
  Random random(seed);
  Wire wire({.batch_bytes = cuts ? 8u * 1024 : 32u * 1024});
  wire.build.add_object("ground", {});
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  REQUIRE(end.client->show(1).has_value());
  constexpr NodeId first = 100;
  NodeId next = first;
  std::size_t bare = 0, seen = 0;
  for (std::uint64_t tick = 2; tick < 600; ++tick) {
    if (tick < 300 && random.below(3) == 0) {
      for (const Command& command : commands_of_a_thing(next)) change(wire, command, tick);
      next += 10;
    }
    // Another look for a thing, made after it was first marked.
    if (next > first && random.below(4) == 0) {
      const NodeId things = (next - first) / 10;
      const NodeId thing = next - 10 * (1 + static_cast<NodeId>(random.below(std::min(things, NodeId{3}))));
      const NodeId look = thing + 3 + static_cast<NodeId>(random.below(5));
      if (!wire.store.find(look)) {
        change(wire, NodeCreate{look, NodeType::material}, tick);
        change(wire, FragmentSet{look, 0, ColorFragment{{0, 0, 1}}}, tick);
        change(wire, LinkSet{thing, 1, {"material", look, 0}}, tick);
      }
    }
    if (cuts && end.connection != 0 && random.below(20) == 0) wire.cut(end);
    if (cuts && end.connection == 0 && random.below(3) == 0) wire.connect(end);
    wire.pump(end, 48 * 1024, random.below(5));
    REQUIRE(end.client->show(tick).has_value());
    bare += !shows_nothing_bare(end.client->store());
    seen = end.client->store().nodes().size();
  }
  CHECK(bare == 0);
  CHECK(end.client->generation() == 1);  // Each connection went on with the mirror of the one before.
  CHECK(seen > 30);
  if (end.connection == 0) wire.connect(end);
  REQUIRE(wire.settle(end));
  REQUIRE(end.client->show(1000).has_value());
  CHECK(same_content(end.client->store(), wire.store));
}

}  // namespace

TEST_CASE("mirrors that got a change at different moments show it from the same tick on") {
  Wire wire;
  const NodeId tree = wire.build.add_object("tree", {});
  auto &near = wire.add("near"), &far = wire.add("far");
  REQUIRE(wire.settle(near));
  REQUIRE(wire.settle(far));
  REQUIRE(near.client->show(9).has_value());
  REQUIRE(far.client->show(9).has_value());
  const auto x_of = [&](auto& end) {
    return std::get<ObjectData>(end.client->store().find(tree)->data).transform.position_m.x;
  };
  change(wire, TransformSet{tree, {{5, 0, 0}}}, 12);
  REQUIRE(wire.settle(near));  // `far` gets it only at the last moment.
  for (const std::uint64_t tick : {10, 11}) {
    REQUIRE(near.client->show(tick).has_value());
    REQUIRE(far.client->show(tick).has_value());
    CHECK(x_of(near) == 0.0);
    CHECK(x_of(far) == 0.0);
  }
  REQUIRE(wire.settle(far));
  REQUIRE(near.client->show(12).has_value());
  REQUIRE(far.client->show(12).has_value());
  CHECK(x_of(near) == 5.0);
  CHECK(x_of(far) == 5.0);
}

TEST_CASE("a node that a later tick shows comes whole at that tick") {
  Wire wire;
  auto& end = wire.add("left");
  wire.build.add_object("", {});
  REQUIRE(wire.settle(end));
  REQUIRE(end.client->show(4).has_value());
  constexpr NodeId deer = 500, mesh = 501;
  const std::vector<Command> batch = {NodeCreate{deer, NodeType::object},
                                      NodeNameSet{deer, "deer"},
                                      TagGroupSet{deer, 0, "draw"},
                                      TagSet{deer, 0, 0, {"to_m", 300.0}},
                                      NodeCreate{mesh, NodeType::geometry},
                                      GeometrySizeSet{mesh, 3, 1},
                                      VerticesSet{mesh, 0, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                      LinkSet{deer, 0, {"geometry", mesh, 0}}};
  for (const Command& command : batch) change(wire, command, 8);
  for (int i = 0; i < 50; ++i) wire.pump(end);
  REQUIRE(end.client->show(7).has_value());
  CHECK_FALSE(end.client->store().find(deer));
  REQUIRE(end.client->show(8).has_value());
  CHECK(same_content(end.client->store(), wire.store));
}

TEST_CASE("in real time no picture has a node whose content is not there yet, however late its messages come") {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    CAPTURE(seed);
    watch_things(seed, false);
  }
}

TEST_CASE("no picture has a node whose content is not there yet while what was lost with a connection is sent again") {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    CAPTURE(seed);
    watch_things(seed, true);
  }
}

TEST_CASE("a screen that has shown nothing yet keeps back what is not whole yet") {
  Wire wire({.batch_bytes = 1024});
  wire.build.add_object("ground", {});
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  for (const Command& command : commands_of_a_thing(100)) change(wire, command, 6);
  for (int messages = 0; !end.client->store().find(100) && messages < 100; ++messages) {
    wire.pump(end, 1u << 20, 1);
    CHECK(shows_nothing_bare(end.client->store()));
  }
  REQUIRE(wire.settle(end));
  CHECK(same_content(end.client->store(), wire.store));
}

TEST_CASE("an editor that is told that its batch was done has all of it") {
  Wire wire;
  wire.build.add_object("ground", {});
  auto& end = wire.add("editor");
  REQUIRE(wire.settle(end));
  for (const Command& command : commands_of_a_thing(100)) change(wire, command, 6);
  wire.server->done(end.connection, 1, 6);
  int pumps = 0;
  for (bool is_told = false; !is_told && pumps < 100; ++pumps) {
    wire.pump(end, 40 * 1024);
    is_told = !end.client->take_done().empty();
    if (is_told) CHECK(same_content(end.client->store(), wire.store));
  }
  CHECK(pumps > 2);
  CHECK(pumps < 100);
}

TEST_CASE("a mirror that has gone beyond a revision, or lacks something of it, is not at it") {
  Wire wire;
  const NodeId tree = wire.build.add_object("tree", {});
  auto& end = wire.add("late");
  REQUIRE(wire.settle(end));
  const std::uint64_t at_5 = wire.store.revision();
  CHECK(end.client->is_at(at_5));
  // The others go on to tick 6 before this one has shown tick 5: the change comes first, that all was sent a message later.
  change(wire, HideSet{tree, true}, 6);
  wire.pump(end, 1u << 20, 1);
  CHECK(std::get<ObjectData>(end.client->store().find(tree)->data).hidden);
  CHECK(end.client->complete_revision() == at_5);
  CHECK_FALSE(end.client->is_at(at_5));
  REQUIRE(wire.settle(end));
  CHECK_FALSE(end.client->is_at(at_5));
  CHECK(end.client->is_at(wire.store.revision()));

  // One that has shown tick 6 keeps tick 7's back, and is at 6 with it.
  const std::uint64_t at_6 = wire.store.revision();
  REQUIRE(end.client->show(6).has_value());
  change(wire, HideSet{tree, false}, 7);
  wire.pump(end, 1u << 20, 1);
  CHECK(end.client->is_at(at_6));
  CHECK(std::get<ObjectData>(end.client->store().find(tree)->data).hidden);

  // What it had is not known to be all on a new connection.
  REQUIRE(wire.settle(end));
  wire.cut(end);
  wire.connect(end);
  CHECK_FALSE(end.client->complete());
  REQUIRE(wire.settle(end));
  CHECK(end.client->is_at(wire.store.revision()));
}

TEST_CASE("what belongs together is held until all of it is there, and what comes behind it waits") {
  Wire wire({.batch_bytes = 100});
  wire.build.add_object("ground", {});
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  REQUIRE(end.client->show(5).has_value());
  constexpr NodeId thing = 500;
  for (const Command& command : std::vector<Command>{
           NodeCreate{thing, NodeType::object}, NodeNameSet{thing, std::string(150, 'n')},
           TagGroupSet{thing, 0, std::string(150, 'g')}, TagSet{thing, 0, 0, {"t", std::string(150, 't')}}})
    change(wire, command, 6);
  for (int messages = 0; messages < 3; ++messages) {
    CHECK_FALSE(end.client->store().find(thing));
    wire.pump(end, 1u << 20, 1);
    REQUIRE(end.client->show(9).has_value());
  }
  REQUIRE(wire.settle(end));
  REQUIRE(end.client->show(9).has_value());
  CHECK(same_content(end.client->store(), wire.store));
}

TEST_CASE("what points at a node made after it was first sent for comes with that node") {
  Wire wire({.batch_bytes = 40});
  wire.build.add_object("ground", {});
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  REQUIRE(end.client->show(5).has_value());
  constexpr NodeId thing = 500, look = 501, later_look = 502;
  const auto make_look = [&](NodeId id, std::uint64_t tick) {
    change(wire, NodeCreate{id, NodeType::material}, tick);
    change(wire, NodeNameSet{id, std::string(100, 'n')}, tick);
    change(wire, FragmentSet{id, 0, ColorFragment{}}, tick);
    change(wire, LinkSet{thing, 1, {std::string(60, 'l'), id, 0}}, tick);  // A message by itself.
  };
  change(wire, NodeCreate{thing, NodeType::object}, 6);
  make_look(look, 6);
  make_look(later_look, 7);  // The link still waits, and is written as it is by then.
  std::size_t with_link = 0;
  for (int messages = 0; messages < 12; ++messages) {
    wire.pump(end, 1u << 20, 1);
    REQUIRE(end.client->show(9).has_value());
    const Node* object = end.client->store().find(thing);
    if (!object || std::get<ObjectData>(object->data).links.empty()) continue;
    ++with_link;
    const Node* worn = end.client->store().find(std::get<ObjectData>(object->data).links.at(1).target);
    REQUIRE(worn);
    CHECK_FALSE(std::get<MaterialData>(worn->data).fragments.empty());
  }
  CHECK(with_link > 0);
}

TEST_CASE("what was to be followed is shown when the server has no more to say") {
  ReplicationClient client;
  client.connected();
  REQUIRE(client.receive(encode(Welcome{1, false, 0, 1000})).has_value());
  REQUIRE(client.show(1).has_value());
  Bytes create;
  scene::encode(NodeCreate{5, NodeType::object}, create);
  REQUIRE(client.receive(encode(CommandBatch{1, 0, create, 2, true})).has_value());
  REQUIRE(client.show(3).has_value());
  CHECK_FALSE(client.store().find(5));
  REQUIRE(client.receive(encode(Complete{1, 0})).has_value());
  REQUIRE(client.show(4).has_value());
  CHECK(client.store().find(5));
}

TEST_CASE("a mirror that is filled anew keeps nothing back") {
  Wire wire;
  const NodeId tree = wire.build.add_object("tree", {});
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  REQUIRE(end.client->show(4).has_value());
  change(wire, HideSet{tree, true}, 90);
  wire.cut(end);
  end.client = std::make_unique<ReplicationClient>();
  wire.connect(end);
  REQUIRE(wire.settle(end));
  CHECK(same_content(end.client->store(), wire.store));
}

}  // namespace septet::replication

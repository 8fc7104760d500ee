#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "tests/engine/replication/wire.hpp"

namespace septet::replication {

using namespace scene;

namespace {

void change(Wire& wire, const Command& command, std::uint64_t tick) {
  REQUIRE(wire.store.apply(command).has_value());
  wire.server->applied(command, tick);
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

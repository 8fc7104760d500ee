#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/command_codec.hpp"
#include "tests/engine/replication/wire.hpp"
#include "tests/engine/scene/sample_commands.hpp"

using namespace septet;
using namespace septet::replication;
using namespace septet::scene;

namespace {

void fill(Wire& wire) {
  for (const Command& command : sample_commands())
    if (command.index() > 2) wire.build.apply(command);
}

geometry::PolygonMesh grid(std::uint32_t side) {
  geometry::PolygonMesh mesh;
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x)
      mesh.vertices_m.push_back({x * 0.5f, y * 0.5f, static_cast<float>((x * 7 + y * 13) % 5) * 0.125f});
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t v = y * (side + 1) + x;
      mesh.polygons.push_back({v, v + 1, v + side + 2, v + side + 1});
      mesh.corner_uvs.push_back({glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}});
    }
  return mesh;
}

/// A random change of the store, of every kind, by its own commands.
void change_something(Wire& wire, Random& random) {
  static const auto commands = sample_commands();
  Command command = commands[random.below(commands.size())];
  std::visit(
      [&](auto& c) {
        using Kind = std::decay_t<decltype(c)>;
        if constexpr (std::is_same_v<Kind, NodeDestroy>)
          if (random.below(4) == 0) c.node = static_cast<NodeId>(1 + random.below(5));
        if constexpr (requires { c.layer; }) {
          if (random.below(3) == 0) c.layer = static_cast<PartId>(random.below(4));
        }
        if constexpr (requires { c.values; })
          for (auto& value : c.values) value = static_cast<std::decay_t<decltype(value)>>(random.below(200));
        if constexpr (requires { c.vertices; }) {
          c.vertices = static_cast<std::uint32_t>(random.below(9));
          c.polygons = static_cast<std::uint32_t>(random.below(4));
        }
      },
      command);
  if (wire.store.apply(command)) wire.server->applied(command);
}

}  // namespace

TEST_CASE("a client that subscribes to everything has the whole store") {
  Wire wire;
  fill(wire);
  auto& end = wire.add("left");
  CHECK_FALSE(end.client->complete());
  REQUIRE(wire.settle(end));
  CHECK(same_content(end.client->store(), wire.store));
}

TEST_CASE("a client that joins late has what a client has that was there from the start") {
  Wire wire;
  auto& early = wire.add("early");
  fill(wire);
  REQUIRE(wire.settle(early));
  wire.build.apply(HideSet{1, false});
  wire.build.apply(VerticesSet{2, 1, {{9, 9, 9}}});
  wire.build.apply(TagDestroy{1, 0, 3});
  auto& late = wire.add("late");
  REQUIRE(wire.settle(early));
  REQUIRE(wire.settle(late));
  CHECK(same_content(early.client->store(), late.client->store()));
  CHECK(same_content(early.client->store(), wire.store));
}

TEST_CASE("nothing is sent that was not subscribed to") {
  Wire wire;
  fill(wire);
  SubscriptionPolicy policy;
  policy.node_types = 1u << static_cast<int>(NodeType::geometry);
  policy.wants_part = [](NodeType, PartKind kind, std::string_view name) {
    return kind == PartKind::layer && name == "vertex";
  };
  auto& end = wire.add("vertices", policy);
  REQUIRE(wire.settle(end));
  const Store& mirror = end.client->store();
  REQUIRE(mirror.nodes().size() == 1);
  const auto& geometry = std::get<GeometryData>(mirror.find(2)->data);
  const auto& original = std::get<GeometryData>(wire.store.find(2)->data);
  CHECK(geometry.vertices_m == original.vertices_m);
  CHECK(geometry.polygons[0][0] == geometry::no_vertex);
  CHECK(geometry.layers.size() == original.layers.size());  // Announced, with their defaults.
  CHECK(geometry.layers.at(2).integers != original.layers.at(2).integers);

  const std::size_t before = end.bytes_to_client;
  wire.build.apply(FragmentSet{3, 0, ColorFragment{{1, 1, 1}}});
  wire.build.apply(LayerIntegersSet{2, 2, 0, {8}});
  REQUIRE(wire.settle(end));
  CHECK(end.bytes_to_client - before < 16);  // Notice of completeness up to the new revision only.
}

TEST_CASE("what changes often while it waits is sent once") {
  Wire wire;
  const NodeId object = wire.build.add_object("", {});
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  const std::size_t before = end.bytes_to_client;
  for (int i = 0; i < 10000; ++i) wire.build.apply(TransformSet{object, {{i * 1.0, 0, 0}}});
  REQUIRE(wire.settle(end));
  CHECK(end.bytes_to_client - before < 200);
  CHECK(std::get<ObjectData>(end.client->store().find(object)->data).transform.position_m.x == 9999.0);
}

TEST_CASE("what was cut off and grew again while it waited is forgotten at the client too") {
  Wire wire;
  fill(wire);
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  wire.build.apply(GeometrySizeSet{2, 1, 0});
  wire.build.apply(GeometrySizeSet{2, 5, 2});
  wire.build.apply(TagGroupDestroy{1, 0});
  wire.build.apply(TagGroupSet{1, 0, "draw"});
  wire.build.apply(BitmapLayerDestroy{4, 0});
  wire.build.apply(BitmapLayerSet{4, 0, "color_r", PixelType::byte});
  REQUIRE(wire.settle(end));
  CHECK(same_content(end.client->store(), wire.store));
}

TEST_CASE("what shrank in one way alone and grew again while it waited is forgotten at the client too") {
  // Two polygons or five vertices are cut to one; the other number stays as it is.
  for (const auto& [vertices, polygons] : {std::pair{1u, 2u}, {5u, 1u}}) {
    Wire wire;
    fill(wire);
    auto& end = wire.add("left");
    REQUIRE(wire.settle(end));
    wire.build.apply(GeometrySizeSet{2, vertices, polygons});
    wire.build.apply(GeometrySizeSet{2, 5, 2});
    REQUIRE(wire.settle(end));
    CHECK(same_content(end.client->store(), wire.store));
  }
}

TEST_CASE("a pump writes about its budget and no more") {
  Wire wire;
  for (int i = 0; i < 4; ++i) wire.build.add_mesh("", grid(150));
  auto& end = wire.add("left");
  std::size_t most = 0;
  while (!end.client->complete()) {
    const std::size_t before = end.bytes_to_client;
    wire.pump(end, 64 * 1024);
    most = std::max(most, end.bytes_to_client - before);
    REQUIRE(end.pumps < 1000);
  }
  CHECK(most < 128 * 1024);
  CHECK(end.pumps > 5);
  CHECK(same_content(end.client->store(), wire.store));
}

TEST_CASE("a client that does not acknowledge is sent a window and no more") {
  Wire wire({.window_bytes = 20 * 1024});
  for (int i = 0; i < 4; ++i) wire.build.add_mesh("", grid(150));
  auto& end = wire.add("hung");
  for (int i = 0; i < 3; ++i) wire.pump(end);
  std::size_t sent = 0;
  for (int i = 0; i < 100; ++i)
    sent += wire.server->pump(end.connection, 1u << 20, [](std::span<const std::byte>) { return true; }).bytes;
  CHECK(sent < 64 * 1024);
  // Traffic to another one that acknowledges.
  auto& other = wire.add("other");
  for (int i = 0; i < 300; ++i) wire.pump(other);
  CHECK(sent < other.bytes_to_client / 4);
}

TEST_CASE("random changes reach a slow client and a resuming one whole") {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    CAPTURE(seed);
    Random random(seed);
    Wire wire({.batch_bytes = 64});
    auto& steady = wire.add("steady");
    auto& broken = wire.add("broken");
    for (int step = 0; step < 1500; ++step) {
      for (std::uint64_t changes = random.below(4); changes > 0; --changes) change_something(wire, random);
      wire.pump(steady, random.below(200), random.below(3));
      wire.pump(broken, random.below(200), random.below(3));
      if (random.below(20) == 0 && broken.connection != 0) wire.cut(broken);
      if (random.below(10) == 0 && broken.connection == 0) wire.connect(broken);
    }
    if (broken.connection == 0) wire.connect(broken);
    REQUIRE(wire.settle(steady));
    REQUIRE(wire.settle(broken));
    CHECK(same_content(steady.client->store(), wire.store));
    CHECK(same_content(broken.client->store(), wire.store));
  }
}

TEST_CASE("a client that comes back is told only what it missed") {
  Wire wire;
  wire.build.add_mesh("", grid(100));
  const NodeId object = wire.build.add_object("", {});
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  const std::uint64_t generation = end.client->generation();
  const std::size_t before = end.bytes_to_client;
  wire.cut(end);
  wire.build.apply(TransformSet{object, {{5, 0, 0}}});
  wire.connect(end);
  REQUIRE(wire.settle(end));
  CHECK(end.bytes_to_client - before < 200);
  CHECK(end.client->generation() == generation);
  CHECK(same_content(end.client->store(), wire.store));
}

TEST_CASE("a client that was cut off before it heard that it has everything hears it when it is back") {
  Wire wire;
  fill(wire);
  auto& end = wire.add("left");
  // Delivers all messages but that notice.
  for (int i = 0; i < 50; ++i) {
    wire.pump(end, 1u << 20, 0);
    for (; !end.to_server.empty(); end.to_server.pop_front())
      REQUIRE(wire.server->receive(end.connection, end.to_server.front()).has_value());
    for (; !end.to_client.empty(); end.to_client.pop_front())
      if (!std::holds_alternative<Complete>(replication::decode(end.to_client.front()).value()))
        REQUIRE(end.client->receive(end.to_client.front()).has_value());
  }
  CHECK(same_content(end.client->store(), wire.store));
  CHECK_FALSE(end.client->complete());
  wire.cut(end);
  wire.connect(end);
  CHECK(wire.settle(end));
}

TEST_CASE("nobody resumes the session of another") {
  Wire wire;
  fill(wire);
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  wire.cut(end);
  end.identity = "right";
  const std::uint64_t generation = end.client->generation();
  wire.connect(end);
  REQUIRE(wire.settle(end));
  CHECK(end.client->generation() != generation);
  CHECK(same_content(end.client->store(), wire.store));
}

TEST_CASE("after a restart of the server the old picture stays until the new one is complete") {
  Wire wire;
  fill(wire);
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  const std::uint64_t generation = end.client->generation();
  wire.cut(end);

  Wire restarted;
  restarted.server = std::make_unique<ReplicationServer>(restarted.store, 2);
  restarted.build.add_mesh("", grid(60));
  auto& again = restarted.ends.emplace_back();
  again.client = std::move(end.client);
  again.identity = "left";
  restarted.connect(again);
  while (again.client->generation() == generation) {
    CHECK(same_content(again.client->store(), wire.store));
    restarted.pump(again, 4096);
    REQUIRE(again.pumps < 1000);
  }
  CHECK(again.client->complete());
  CHECK(same_content(again.client->store(), restarted.store));
}

TEST_CASE("a client that finds a fault says hello again and is whole in the end") {
  Wire wire;
  fill(wire);
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  CHECK_FALSE(end.client->receive(Bytes(3, std::byte{0xff})).has_value());
  CHECK(same_content(end.client->store(), wire.store));
  wire.build.apply(HideSet{1, false});
  REQUIRE(wire.settle(end));
  CHECK(same_content(end.client->store(), wire.store));
}

TEST_CASE("a change that a client asks for is handed to the owner of the store") {
  Wire wire;
  fill(wire);
  auto& end = wire.add("editor");
  REQUIRE(wire.settle(end));
  end.client->request(NodeNameSet{1, "renamed"});
  CHECK_FALSE(end.client->complete());
  REQUIRE(wire.settle(end));
  REQUIRE(wire.requested.size() == 1);
  CHECK(wire.store.find(1)->name != "renamed");
  wire.build.apply(wire.requested[0]);
  REQUIRE(wire.settle(end));
  CHECK(end.client->store().find(1)->name == "renamed");
}

TEST_CASE("hostile bytes are refused by both ends and change nothing") {
  Random random(5);
  Wire wire;
  fill(wire);
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  const std::uint64_t revision = wire.store.revision();
  Bytes commands;
  for (const Command& command : sample_commands()) scene::encode(command, commands);
  const std::vector<Bytes> messages = {encode(Hello{7, 9}), encode(Welcome{1, true, 3}),
                                       encode(CommandBatch{2, 1, commands}), encode(Complete{9, 9}),
                                       encode(Received{1000})};
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    Bytes bytes = messages[random.below(messages.size())];
    if (random.below(2)) bytes.resize(random.below(bytes.size() + 1));
    for (std::uint64_t k = random.below(4); k > 0 && !bytes.empty(); --k)
      bytes[random.below(bytes.size())] = static_cast<std::byte>(random.below(256));
    refused += !wire.server->receive(end.connection, bytes).has_value();
    ReplicationClient victim;
    victim.connected();
    (void)victim.receive(encode(Welcome{1, false, 0}));
    refused += !victim.receive(bytes).has_value();
  }
  CHECK(refused > 4000);
  CHECK(wire.store.revision() == revision);
}

TEST_CASE("a batch that claims to unpack to more than it may is refused") {
  Bytes big(3u << 20, std::byte{0});
  CHECK_FALSE(replication::decode(encode(CommandBatch{1, 0, big})).has_value());
  Bytes fair(1u << 20, std::byte{0});
  const Bytes packed = encode(CommandBatch{1, 0, fair});
  CHECK(packed.size() < 2000);
  CHECK(std::get<CommandBatch>(replication::decode(packed).value()).commands == fair);
}

TEST_CASE("what grew and was cut off and grew again while it waited is forgotten at the client too") {
  Wire wire;
  fill(wire);
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  wire.build.apply(GeometrySizeSet{2, 9, 4});
  wire.build.apply(GeometrySizeSet{2, 1, 0});
  wire.build.apply(GeometrySizeSet{2, 9, 4});
  REQUIRE(wire.settle(end));
  CHECK(same_content(end.client->store(), wire.store));
}

TEST_CASE("a tag that waits while its group is made anew is there afterwards") {
  Wire wire;
  fill(wire);
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  wire.build.apply(TagSet{1, 0, 0, {"to_m", 7.0}});
  wire.build.apply(TagGroupDestroy{1, 0});
  wire.build.apply(TagGroupSet{1, 0, "draw"});
  wire.build.apply(TagSet{1, 0, 0, {"to_m", 8.0}});
  REQUIRE(wire.settle(end));
  CHECK(same_content(end.client->store(), wire.store));
}

// Sessions that a server resumes, and its acceptance of a client's messages.

#include <doctest/doctest.h>

#include "engine/replication/message.hpp"
#include "engine/scene/command_codec.hpp"
#include "tests/engine/replication/wire.hpp"

using namespace septet;
using namespace septet::replication;
using namespace septet::scene;

namespace {

// A client that sends the test's messages.
struct Raw {
  explicit Raw(const ReplicationOptions& options = {}) : server(store, 1, options) {
    for (NodeId id = 1; id <= 3; ++id) REQUIRE(store.apply(NodeCreate{id, NodeType::object}).has_value());
    server.connect(1, "left");
  }
  bool says(const Message& message) { return server.receive(connection, replication::encode(message)).has_value(); }
  bool asks(const std::vector<Command>& commands) {
    Bytes bytes;
    for (const Command& command : commands) scene::encode(command, bytes);
    return says(CommandBatch{++sequence, 0, bytes});
  }
  void cut() {
    server.disconnect(connection);
    server.connect(++connection, "left");
  }
  std::vector<Message> hears() {
    std::vector<Message> messages;
    server.pump(connection, 1u << 20, [&](std::span<const std::byte> bytes) {
      messages.push_back(replication::decode(bytes).value());
      return true;
    });
    return messages;
  }
  Welcome hello(std::uint64_t token, std::uint64_t received) {
    REQUIRE(says(Hello{token, received}));
    return std::get<Welcome>(hears().at(0));
  }

  Store store;
  ReplicationServer server;
  ConnectionId connection = 1;
  std::uint64_t sequence = 0;
};

std::uint64_t newest_batch(const std::vector<Message>& messages) {
  std::uint64_t newest = 0;
  for (const Message& message : messages)
    if (const auto* batch = std::get_if<CommandBatch>(&message)) newest = batch->sequence;
  return newest;
}

}  // namespace

TEST_CASE("a session goes on from any batch that is not acknowledged yet and from no other") {
  // Three batches are sent; the first one is acknowledged.
  for (const std::uint64_t received : {0u, 1u, 2u, 3u, 4u}) {
    CAPTURE(received);
    Raw raw({.batch_bytes = 1});
    const Welcome welcome = raw.hello(0, 0);
    CHECK_FALSE(welcome.resumed);
    REQUIRE(raw.asks({NodeIndexSubscribe{1}}));
    REQUIRE(newest_batch(raw.hears()) == 3);
    REQUIRE(raw.says(Received{1}));
    raw.cut();
    const Welcome again = raw.hello(welcome.token, received);
    CHECK(again.resumed == (received >= 1 && received <= 3));
    CHECK((again.token == welcome.token) == again.resumed);
  }
}

TEST_CASE("a session whose batches are all acknowledged goes on from the last and not from before it") {
  for (const std::uint64_t received : {2u, 3u}) {
    Raw raw({.batch_bytes = 1});
    const Welcome welcome = raw.hello(0, 0);
    REQUIRE(raw.asks({NodeIndexSubscribe{1}}));
    REQUIRE(newest_batch(raw.hears()) == 3);
    REQUIRE(raw.says(Received{3}));
    raw.cut();
    CHECK(raw.hello(welcome.token, received).resumed == (received == 3));
  }
}

TEST_CASE("of the sessions that were cut off the newest are kept") {
  Wire wire({.lost_sessions = 2});
  wire.build.add_object("", {});
  std::vector<Wire::End*> ends;
  for (const char* name : {"a", "b", "c"}) {
    ends.push_back(&wire.add(name));
    REQUIRE(wire.settle(*ends.back()));
  }
  std::vector<std::uint64_t> generations;
  for (Wire::End* end : ends) {
    generations.push_back(end->client->generation());
    wire.cut(*end);
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    wire.connect(*ends[i]);
    REQUIRE(wire.settle(*ends[i]));
    CHECK((ends[i]->client->generation() == generations[i]) == (i > 0));
  }
}

TEST_CASE("a client may have so many subscriptions waiting and no more") {
  for (const std::size_t count : {3u, 4u}) {
    Raw raw({.waiting_requests = 3});
    raw.hello(0, 0);
    CHECK(raw.asks(std::vector<Command>(count, NodeSubscribe{1, true})) == (count == 3));
  }
}

TEST_CASE("a batch that comes again is taken once and one that is missing ends the connection") {
  Raw raw;
  raw.hello(0, 0);
  Bytes change;
  scene::encode(HideSet{1, true}, change);
  CHECK(raw.server.receive(1, replication::encode(CommandBatch{1, 0, change})).value().changes.size() == 1);
  CHECK(raw.server.receive(1, replication::encode(CommandBatch{1, 0, change})).value().changes.empty());
  CHECK_FALSE(raw.server.receive(1, replication::encode(CommandBatch{3, 0, change})).has_value());
  // The client gets its received sequence.
  bool told = false;
  for (const Message& message : raw.hears())
    if (const auto* received = std::get_if<Received>(&message)) told = received->sequence == 1;
  CHECK(told);
}

TEST_CASE("whoever subscribes to a node without the index learns of its end and not of other nodes") {
  Raw raw;
  raw.hello(0, 0);
  REQUIRE(raw.asks({NodeSubscribe{2, true}}));
  raw.hears();
  for (const NodeId id : {1u, 2u}) {
    REQUIRE(raw.store.apply(NodeDestroy{id}).has_value());
    raw.server.applied(NodeDestroy{id});
  }
  std::vector<Command> heard;
  for (const Message& message : raw.hears())
    if (const auto* batch = std::get_if<CommandBatch>(&message)) {
      ByteReader in(batch->commands);
      while (!in.at_end()) heard.push_back(scene::decode(in).value());
    }
  CHECK(heard == std::vector<Command>{NodeDestroy{2}});
}

TEST_CASE("an id that is given to a node of another type says nothing of the first one") {
  Wire wire;
  auto& end = wire.add("left");
  REQUIRE(wire.store.apply(NodeCreate{9, NodeType::object}).has_value());
  wire.server->applied(NodeCreate{9, NodeType::object});
  REQUIRE(wire.settle(end));
  wire.cut(end);
  for (const Command& command :
       {Command(HideSet{9, true}), Command(TransformSet{9, {{1, 2, 3}}}), Command(NodeDestroy{9}),
        Command(NodeCreate{9, NodeType::geometry}), Command(GeometrySizeSet{9, 3, 1})}) {
    REQUIRE(wire.store.apply(command).has_value());
    wire.server->applied(command);
  }
  wire.connect(end);
  REQUIRE(wire.settle(end));
  CHECK(same_content(end.client->store(), wire.store));
}

TEST_CASE("commands are packed where that makes them smaller and unpacked to exactly what they were") {
  Bytes commands;
  for (int i = 0; i < 300; ++i) scene::encode(HideSet{1, true}, commands);
  Bytes bytes = replication::encode(CommandBatch{1, 0, commands});
  CHECK(bytes.size() < commands.size() / 4);
  CHECK(std::get<CommandBatch>(replication::decode(bytes).value()).commands == commands);
  Bytes few(commands.begin(), commands.begin() + 100);
  CHECK(replication::encode(CommandBatch{1, 0, few}).size() == 7 + few.size());
  // A claim of another size is refused: version, kind, sequence, received, tick, goes on, packing, then the size as a varint of two
  // bytes.
  REQUIRE(bytes[6] == std::byte{1});
  for (const int by : {-1, 1}) {
    Bytes wrong = bytes;
    wrong[7] = static_cast<std::byte>(static_cast<int>(wrong[7]) + by);
    CHECK_FALSE(replication::decode(wrong).has_value());
  }
}

TEST_CASE("every node of a large world is listed") {
  Wire wire;
  for (int i = 0; i < 800; ++i) wire.build.add_object("", {});
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  CHECK(end.client->store().nodes().size() == 800);
}

TEST_CASE("a small window is enough for a large world because clients acknowledge what they have") {
  Wire wire({.batch_bytes = 512, .window_bytes = 2048});
  for (int i = 0; i < 400; ++i) wire.build.add_object("", {});
  auto& end = wire.add("left");
  REQUIRE(wire.settle(end));
  // No more requests: acknowledgements go alone.
  for (NodeId id = 1; id <= 400; ++id) wire.build.apply(TransformSet{id, {{1.0 * id, 0, 0}}});
  REQUIRE(wire.settle(end));
  CHECK(same_content(end.client->store(), wire.store));
}

TEST_CASE("a client takes a batch that comes again once and says hello again where one is missing") {
  ReplicationClient client;
  client.connected();
  REQUIRE(client.receive(replication::encode(Welcome{7, false, 0})).has_value());
  Bytes create;
  scene::encode(NodeCreate{1, NodeType::object}, create);
  CHECK(client.receive(replication::encode(CommandBatch{1, 0, create})).has_value());
  CHECK(client.receive(replication::encode(CommandBatch{1, 0, create})).has_value());
  CHECK(client.store().nodes().size() == 1);
  // Before its first request nothing can be complete.
  CHECK(client.receive(replication::encode(Complete{1, 0})).has_value());
  CHECK_FALSE(client.complete());
  CHECK_FALSE(client.receive(replication::encode(CommandBatch{3, 0, create})).has_value());
  std::vector<Message> said;
  client.pump([&](std::span<const std::byte> bytes) {
    said.push_back(replication::decode(bytes).value());
    return true;
  });
  REQUIRE(said.size() == 1);
  CHECK(std::get<Hello>(said[0]).token == 0);
}

TEST_CASE("what an earlier connection sent is not taken before the welcome of the new one") {
  ReplicationClient client;
  client.connected();
  REQUIRE(client.receive(replication::encode(Welcome{7, false, 0})).has_value());
  client.connected();
  Bytes create;
  scene::encode(NodeCreate{1, NodeType::object}, create);
  CHECK(client.receive(replication::encode(CommandBatch{1, 0, create})).has_value());
  CHECK(client.store().nodes().empty());
}

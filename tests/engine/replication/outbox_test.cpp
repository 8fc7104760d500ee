#include "engine/replication/outbox.hpp"

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "engine/scene/command_codec.hpp"

using namespace septet;
using namespace septet::replication;
using namespace septet::scene;

namespace {

constexpr NodeId node = 1;

Store store_of(std::uint32_t vertices) {
  Store store;
  REQUIRE(store.apply(NodeCreate{node, NodeType::geometry}).has_value());
  REQUIRE(store.apply(GeometrySizeSet{node, vertices, 0}).has_value());
  return store;
}

Change vertices(std::uint32_t first, std::uint32_t end) {
  return {{node, SubjectKind::vertices, base_vertex_layer, 0}, first, end};
}

std::vector<Command> written(Outbox& outbox, const Store& store, std::size_t bytes = 1u << 30) {
  Bytes out;
  std::vector<Change> sent;
  outbox.write(store, bytes, out, sent);
  std::vector<Command> commands;
  ByteReader in(out);
  while (!in.at_end()) commands.push_back(decode(in).value());
  return commands;
}

// Number of times that each vertex is sent.
std::vector<int> sendings(const std::vector<Command>& commands, std::size_t vertices) {
  std::vector<int> times(vertices);
  for (const Command& command : commands)
    if (const auto* run = std::get_if<VerticesSet>(&command))
      for (std::size_t i = 0; i < run->positions_m.size(); ++i) ++times[run->first + i];
  return times;
}

}  // namespace

TEST_CASE("a range that changes again within one that waits takes nothing away from it") {
  const Store store = store_of(100);
  Outbox outbox;
  outbox.mark(vertices(0, 100));
  outbox.mark(vertices(10, 20));
  CHECK(sendings(written(outbox, store), 100) == std::vector<int>(100, 1));
  CHECK(outbox.empty());
}

TEST_CASE("of overlapping changes every element is sent once and none that did not change") {
  Random random(6);
  const Store store = store_of(300);
  for (int round = 0; round < 300; ++round) {
    Outbox outbox;
    std::vector<int> expected(300);
    for (std::uint64_t changes = 1 + random.below(12); changes > 0; --changes) {
      const auto first = static_cast<std::uint32_t>(random.below(290)),
                 end = first + 1 + static_cast<std::uint32_t>(random.below(10));
      outbox.mark(vertices(first, end));
      std::fill(expected.begin() + first, expected.begin() + end, 1);
    }
    REQUIRE(sendings(written(outbox, store), 300) == expected);
  }
}

TEST_CASE("more than sixty-four ranges of one layer become one with what lies between") {
  const Store store = store_of(1000);
  for (const std::uint32_t ranges : {64u, 65u}) {
    Outbox outbox;
    for (std::uint32_t i = 0; i < ranges; ++i) outbox.mark(vertices(10 * i, 10 * i + 1));
    std::size_t runs = 0;
    const std::vector<Command> commands = written(outbox, store);
    for (const Command& command : commands) runs += std::holds_alternative<VerticesSet>(command);
    CHECK(runs == (ranges == 64 ? 64 : 1));
    const std::vector<int> times = sendings(commands, 1000);
    for (std::uint32_t i = 0; i < ranges; ++i) REQUIRE(times[10 * i] == 1);
    CHECK(times[10 * ranges] == 0);
  }
}

TEST_CASE("what was cut off while it waited is not sent and the size goes before what lies within it") {
  const Store store = store_of(50);
  Outbox outbox;
  outbox.mark(vertices(40, 90));
  outbox.mark({{node, SubjectKind::geometry_size, 0, 0}});
  const std::vector<Command> commands = written(outbox, store);
  REQUIRE(commands.size() == 2);
  REQUIRE(std::holds_alternative<GeometrySizeSet>(commands[0]));
  const auto* run = std::get_if<VerticesSet>(&commands[1]);
  REQUIRE(run != nullptr);
  CHECK(run->first == 40);
  CHECK(run->positions_m.size() == 10);
}

TEST_CASE("a long range goes out in pieces of about 24 KiB as there is room") {
  const Store store = store_of(5000);
  Outbox outbox;
  outbox.mark(vertices(0, 5000));
  const std::vector<Command> first = written(outbox, store, 1);
  REQUIRE(first.size() == 1);
  CHECK(std::get<VerticesSet>(first[0]).positions_m.size() == 24 * 1024 / 12);
  CHECK_FALSE(outbox.empty());
  std::vector<int> times = sendings(first, 5000);
  while (!outbox.empty()) {
    const std::vector<int> more = sendings(written(outbox, store, 1), 5000);
    for (std::size_t i = 0; i < times.size(); ++i) times[i] += more[i];
  }
  CHECK(times == std::vector<int>(5000, 1));
}

TEST_CASE("what is forgotten is not sent and what stands beside it is") {
  Store store = store_of(10);
  REQUIRE(store.apply(NodeNameSet{node, "a"}).has_value());
  Outbox outbox;
  outbox.mark({{node, SubjectKind::name, 0, 0}});
  outbox.mark(vertices(0, 10));
  outbox.forget({node, SubjectKind::vertices, 0, 0}, {node, SubjectKind::tiles, 0xFFFF, 0xFFFF});
  const std::vector<Command> commands = written(outbox, store);
  REQUIRE(commands.size() == 1);
  CHECK(std::holds_alternative<NodeNameSet>(commands[0]));
  CHECK(outbox.empty());
}

TEST_CASE("a change of a layer's values is of as many elements as it sets") {
  Store store = store_of(10);
  REQUIRE(store.apply(GeometryLayerSet{node, 3, "uv", LayerType::vertex_xyz, 0, 0.0}).has_value());
  const LayerRealsSet set{node, 3, 2, std::vector<float>(4 * layer_width(LayerType::vertex_xyz))};
  const auto change = change_of(set, store);
  REQUIRE(change);
  CHECK(change->first == 2);
  CHECK(change->end == 6);
}

TEST_CASE("a tag's group is there before its tag whichever of them waits longer") {
  Store store = store_of(1);
  REQUIRE(store.apply(TagGroupSet{node, 2, "draw"}).has_value());
  REQUIRE(store.apply(TagSet{node, 2, 5, {"to_m", 7.0}}).has_value());
  Outbox outbox;
  outbox.mark({{node, SubjectKind::tag, 2, 5}});
  Change made_anew{{node, SubjectKind::tag_group, 2, 0}};
  made_anew.renew = true;
  outbox.mark(made_anew);
  const auto commands = written(outbox, store);
  REQUIRE(commands.size() == 3);
  CHECK(std::holds_alternative<TagGroupDestroy>(commands[0]));
  CHECK(std::holds_alternative<TagGroupSet>(commands[1]));
  CHECK(std::holds_alternative<TagSet>(commands[2]));
}

TEST_CASE("what waits of a node that is of another type by now says nothing") {
  const Store store = store_of(3);  // A geometry.
  Outbox outbox;
  for (const SubjectKind kind : {SubjectKind::transform, SubjectKind::hide, SubjectKind::link, SubjectKind::fragment,
                                 SubjectKind::bitmap_size, SubjectKind::bitmap_layer})
    outbox.mark({{node, kind, 0, 0}});
  CHECK(written(outbox, store).empty());
  CHECK(outbox.empty());
}

TEST_CASE("what was lost is written before all that waits, as it is now, and with all that changed up to its tick") {
  Store store = store_of(100);
  for (const NodeId id : {2u, 3u}) REQUIRE(store.apply(NodeCreate{id, NodeType::object}).has_value());
  const auto name = [](NodeId id) { return Change{{id, SubjectKind::name, 0, 0}}; };
  Outbox outbox;
  outbox.mark(name(3), 8);
  outbox.mark(vertices(10, 20), 8);
  outbox.mark(name(2), 9);
  const std::vector<Change> lost{name(2), vertices(0, 5)};
  outbox.mark_lost(lost, 7);
  REQUIRE(store.apply(NodeNameSet{2, "now"}).has_value());

  const std::vector<Command> first = written(outbox, store, 1);
  REQUIRE(first.size() == 1);
  CHECK(std::get<NodeNameSet>(first[0]).name == "now");
  CHECK(outbox.goes_on());  // Its last change was at 9.
  const std::vector<Command> rest = written(outbox, store);
  REQUIRE(rest.size() == 3);
  CHECK(std::get<VerticesSet>(rest[0]).first == 0);
  CHECK(std::get<VerticesSet>(rest[1]).first == 10);
  CHECK(std::get<NodeNameSet>(rest[2]).node == 3);
  CHECK(outbox.empty());
  CHECK_FALSE(outbox.goes_on());
}

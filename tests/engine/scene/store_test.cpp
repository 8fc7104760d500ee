#include "engine/scene/store.hpp"

#include <doctest/doctest.h>

#include "tests/engine/scene/sample_commands.hpp"

using namespace septet;
using namespace septet::scene;

namespace {

Store copy_by_commands(const Store& store, std::size_t run_values) {
  Store copy;
  describe_store(
      store, [&](const Command& command) { must_apply(copy, command); }, run_values);
  return copy;
}

Store store_with_geometry(std::uint32_t vertices, std::uint32_t polygons) {
  Store store;
  must_apply(store, NodeCreate{1, NodeType::geometry});
  must_apply(store, GeometrySizeSet{1, vertices, polygons});
  return store;
}

}  // namespace

TEST_CASE("a store described by commands is built again alike") {
  const Store store = sample_store();
  REQUIRE(store.nodes().size() == 4);
  for (const std::size_t run : {1, 7, 65536}) CHECK(same_content(store, copy_by_commands(store, run)));
}

TEST_CASE("stores that differ in one value are not the same") {
  for (const Command& change :
       {Command(HideSet{1, false}), Command(TagSet{1, 0, 0, {"flag", false}}), Command(VerticesSet{2, 4, {{1, 2, 3}}}),
        Command(LayerIntegersSet{2, 2, 0, {3}}), Command(FragmentSet{3, 0, ColorFragment{}}),
        Command(BitmapTilesSet{4, 0, 0, std::vector<std::uint8_t>(64, 1)}), Command(NodeNameSet{1, "model/lorry"}),
        Command(TagGroupSet{1, 0, "drawn"}), Command(TagSet{1, 0, 1, {"number", std::uint32_t{4000000000u}}}),
        Command(LinkSet{1, 1, {"material", 3, 6}}),
        Command(MotionSet{1, {{10.0, 9.0, 7.0}, {1, 0, 0, 0}, {{1.0, {1, 0, 0}}}}}),
        Command(GeometryLayerSet{2, 0, "map_v", LayerType::corner_real, 0, 0.5f}),
        Command(GeometryLayerSet{2, 0, "map_u", LayerType::corner_real, 0, 0.25f}),
        Command(CreaseSet{2, CreaseKind::edge, {"crease", 8}}), Command(BitmapSizeSet{4, 17, 10, 1}),
        Command(BitmapLayerSet{4, 0, "color_g", PixelType::byte}),
        Command(BitmapLayerSet{4, 1, "height", PixelType::real64}), Command(NodeDestroy{2})}) {
    CAPTURE(name_of(change));
    Store changed = sample_store();
    must_apply(changed, change);
    CHECK_FALSE(same_content(changed, sample_store()));
  }
}

TEST_CASE("a refused command changes nothing") {
  const Store before = sample_store();
  const std::vector<Command> bad = {
      NodeIndexSubscribe{1},
      NodeCreate{1, NodeType::object},
      NodeCreate{no_node, NodeType::object},
      NodeNameSet{99, "nobody"},
      NodeNameSet{1, std::string(256, 'x')},
      TagSet{1, 9, 0, {"no group", true}},
      TransformSet{2, {}},
      TransformSet{1, {{}, {0.0, 0.0, 0.0, 0.0}}},
      GeometrySizeSet{2, 0xFFFFFFFFu, 0},
      VerticesSet{2, 5, {{0, 0, 0}}},
      VerticesSet{2, 0xFFFFFFFFu, {{0, 0, 0}}},
      LayerIntegersSet{2, 0, 0, {1, 2, 3, 4}},  // a real layer
      LayerIntegersSet{2, 1, 0, {1, 2, 3}},     // three corners
      LayerIntegersSet{2, 2, 0, {256}},         // a byte layer
      GeometryLayerSet{2, 9, "bytes", LayerType::face_byte, 256, 0.0f},
      LayerRealsSet{2, 77, 0, {1.0f}},
      BitmapSizeSet{4, 100000, 1, 1},
      BitmapSizeSet{4, 8192, 8192, 8192},
      BitmapTilesSet{4, 0, 0, std::vector<std::uint8_t>(65, 0)},
      BitmapTilesSet{4, 0, 6, std::vector<std::uint8_t>(64, 0)},
      FragmentSet{3, no_fragment, ColorFragment{}},
      FragmentSet{3, 0, RampFragment{}},
  };
  for (const Command& command : bad) {
    CAPTURE(name_of(command));
    Store store = sample_store();
    const auto done = store.apply(command);
    REQUIRE_FALSE(done.has_value());
    CHECK_FALSE(done.error().what.empty());
    CHECK_FALSE(done.error().remedy.empty());
    CHECK(same_content(store, before));
    CHECK(store.revision() == before.revision());
    CHECK(store.content_bytes() == before.content_bytes());
  }
}

TEST_CASE("random commands never break a store and its account of bytes stays true") {
  Random random(2);
  const auto commands = sample_commands();
  Store store({.nodes = 8, .bytes = 40000});
  for (int i = 0; i < 20000; ++i) {
    Command command = commands[random.below(commands.size())];
    std::visit(
        [&](auto& c) {
          if constexpr (requires { c.node; })
            if (random.below(4) == 0) c.node = static_cast<NodeId>(random.below(10));
        },
        command);
    (void)store.apply(command);
    REQUIRE(store.content_bytes() <= 40000);
  }
  const Store copy = copy_by_commands(store, 65536);
  CHECK(same_content(copy, store));
  CHECK(copy.content_bytes() == store.content_bytes());
  std::vector<NodeId> ids;
  for (const auto& [id, node] : store.nodes()) ids.push_back(id);
  for (const NodeId id : ids) must_apply(store, NodeDestroy{id});
  CHECK(store.content_bytes() == 0);
}

TEST_CASE("ids are never given twice") {
  Store store;
  const NodeId first = store.assign_id();
  must_apply(store, NodeCreate{first, NodeType::object});
  must_apply(store, NodeDestroy{first});
  CHECK(store.assign_id() != first);
  must_apply(store, NodeCreate{500, NodeType::object});
  CHECK(store.assign_id() == 501);
}

TEST_CASE("a change carries a revision to its part and its node and to no other") {
  Store store = sample_store();
  const auto& geometry = std::get<GeometryData>(store.find(2)->data);
  const std::uint64_t shape = geometry.shape_revision, other = store.find(1)->revision;
  must_apply(store, LayerIntegersSet{2, 2, 0, {9}});
  CHECK(geometry.layers.at(2).revision == store.revision());
  CHECK(store.find(2)->revision == store.revision());
  CHECK(geometry.shape_revision == shape);
  CHECK(store.find(1)->revision == other);
}

TEST_CASE("a destroy of what is not there does nothing") {
  Store store = sample_store();
  const std::uint64_t revision = store.revision();
  must_apply(store, NodeDestroy{99});
  must_apply(store, LinkDestroy{1, 99});
  must_apply(store, TagDestroy{1, 0, 99});
  CHECK(store.revision() == revision);
}

TEST_CASE("a geometry that grows shows the defaults of its layers and one that shrinks forgets") {
  Store store = store_with_geometry(2, 1);
  must_apply(store, GeometryLayerSet{1, 0, "weight", LayerType::vertex_real, 0, 0.5f});
  must_apply(store, VerticesSet{1, 0, {{1, 1, 1}, {2, 2, 2}}});
  must_apply(store, GeometrySizeSet{1, 1, 1});
  must_apply(store, GeometrySizeSet{1, 3, 1});
  const auto& geometry = std::get<GeometryData>(store.find(1)->data);
  CHECK(geometry.vertices_m == std::vector<glm::vec3>{{1, 1, 1}, {0, 0, 0}, {0, 0, 0}});
  CHECK(geometry.layers.at(0).reals == std::vector<float>{0.5f, 0.5f, 0.5f});
}

TEST_CASE("a hostile size cannot fill the memory") {
  Store store({.bytes = 1 << 20});
  int refused = 0;
  for (NodeId id = 1; id < 100; ++id) {
    if (!store.apply(NodeCreate{id, NodeType::geometry})) ++refused;
    if (!store.apply(GeometrySizeSet{id, 1u << 20, 1u << 20})) ++refused;
  }
  CHECK(refused == 99);
  CHECK(store.content_bytes() <= 1 << 20);
}

TEST_CASE("a store takes as many nodes as its limit says and one more when one is destroyed") {
  Store store({.nodes = 8});
  for (NodeId id = 1; id <= 8; ++id) CHECK(store.apply(NodeCreate{id, NodeType::object}).has_value());
  CHECK_FALSE(store.apply(NodeCreate{9, NodeType::object}).has_value());
  must_apply(store, NodeDestroy{3});
  CHECK(store.apply(NodeCreate{9, NodeType::object}).has_value());
}

TEST_CASE("a store is filled to the last byte and no further") {
  Store probe;
  must_apply(probe, NodeCreate{1, NodeType::object});
  must_apply(probe, NodeNameSet{1, "1234567"});
  for (const std::uint64_t missing : {0u, 1u}) {
    Store store({.bytes = probe.content_bytes() - missing});
    must_apply(store, NodeCreate{1, NodeType::object});
    CHECK(store.apply(NodeNameSet{1, "1234567"}).has_value() == (missing == 0));
  }
}

TEST_CASE("a tag that changes carries a revision to its group and a node that comes or goes to the index") {
  Store store = sample_store();
  const std::uint64_t index = store.index_revision();
  must_apply(store, TagSet{1, 0, 0, {"flag", false}});
  CHECK(store.find(1)->tag_groups.at(0).revision == store.revision());
  CHECK(store.find(1)->revision == store.revision());
  must_apply(store, TagDestroy{1, 0, 0});
  CHECK(store.find(1)->tag_groups.at(0).revision == store.revision());
  CHECK(store.index_revision() == index);
  must_apply(store, NodeDestroy{4});
  CHECK(store.index_revision() == store.revision());
  CHECK(store.index_revision() > index);
}

TEST_CASE("a layer keeps its values under another name and loses them with another type") {
  Store store = store_with_geometry(2, 1);
  must_apply(store, GeometryLayerSet{1, 0, "a", LayerType::vertex_integer, 3, 0.0f});
  must_apply(store, LayerIntegersSet{1, 0, 1, {9}});
  must_apply(store, GeometryLayerSet{1, 0, "b", LayerType::vertex_integer, 5, 0.0f});
  const auto& geometry = std::get<GeometryData>(store.find(1)->data);
  CHECK(geometry.layers.at(0).name == "b");
  CHECK(geometry.layers.at(0).integers == std::vector<std::uint32_t>{3, 9});
  must_apply(store, GeometryLayerSet{1, 0, "b", LayerType::corner_integer, 5, 0.0f});
  CHECK(geometry.layers.at(0).integers == std::vector<std::uint32_t>(4, 5));
  must_apply(store, NodeCreate{2, NodeType::bitmap});
  must_apply(store, BitmapSizeSet{2, 8, 8, 1});
  must_apply(store, BitmapLayerSet{2, 0, "a", PixelType::byte});
  must_apply(store, BitmapTilesSet{2, 0, 0, std::vector<std::uint8_t>(64, 7)});
  must_apply(store, BitmapLayerSet{2, 0, "b", PixelType::byte});
  const auto& bitmap = std::get<BitmapData>(store.find(2)->data);
  CHECK(bitmap.layers.at(0).tiles == std::vector<std::uint8_t>(64, 7));
  must_apply(store, BitmapLayerSet{2, 0, "b", PixelType::word});
  CHECK(bitmap.layers.at(0).tiles == std::vector<std::uint8_t>(128, 0));
}

TEST_CASE("values go where their run begins and may end with the layer") {
  Store store = store_with_geometry(3, 2);
  must_apply(store, GeometryLayerSet{1, 0, "corner", LayerType::corner_real, 0, 0.0f});
  must_apply(store, LayerRealsSet{1, 0, 1, {1, 2, 3, 4}});
  const auto& geometry = std::get<GeometryData>(store.find(1)->data);
  CHECK(geometry.layers.at(0).reals == std::vector<float>{0, 0, 0, 0, 1, 2, 3, 4});
  CHECK_FALSE(store.apply(LayerRealsSet{1, 0, 2, {1, 2, 3, 4}}).has_value());
  CHECK(store.apply(VerticesSet{1, 2, {{1, 1, 1}}}).has_value());
  CHECK_FALSE(store.apply(VerticesSet{1, 3, {{1, 1, 1}}}).has_value());
}

TEST_CASE("no id is given out that could wrap") {
  Store store;
  CHECK(store.apply(NodeCreate{0xEFFFFFFFu, NodeType::object}).has_value());
  CHECK_FALSE(store.apply(NodeCreate{0xF0000000u, NodeType::object}).has_value());
  CHECK_FALSE(store.apply(NodeCreate{0, NodeType::object}).has_value());
}

#include "engine/editor/content_ahead.hpp"

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/bytes.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/scene/growth.hpp"
#include "engine/scene/store.hpp"

namespace septet::editor {
namespace {

using namespace scene;

/// A thing with a picture of so many runs of a megabyte.
std::vector<Command> thing_with_picture(std::size_t runs) {
  std::vector<Command> commands{NodeCreate{1, NodeType::bitmap}, BitmapSizeSet{1, 1024, 1024, 1}};
  for (std::size_t i = 0; i < runs; ++i)
    commands.emplace_back(BitmapTilesSet{1, 0, 0, std::vector<std::uint8_t>(max_run_bytes)});
  commands.insert(commands.end(),
                  {NodeCreate{2, NodeType::object}, NodeNameSet{2, "thing"}, LinkSet{2, 0, {"material", 3, 0}},
                   NodeCreate{3, NodeType::material}, FragmentSet{3, 0, ColorFragment{}}, HideSet{9, true}});
  return commands;
}

}  // namespace

TEST_CASE("a batch that one message holds is sent as it is") {
  const auto commands = thing_with_picture(1);
  const SplitBatch split = split_content(commands);
  CHECK(split.ahead.empty());
  CHECK(split.rest == commands);
}

TEST_CASE("of a larger one the contents go ahead in batches that a message holds, and what shows them comes whole") {
  const auto commands = thing_with_picture(5);
  const SplitBatch split = split_content(commands);
  CHECK(split.ahead.size() > 2);
  std::size_t ahead = 0;
  for (const auto& batch : split.ahead) {
    Bytes bytes;
    for (const Command& command : batch) encode(command, bytes);
    CHECK(bytes.size() <= replication::max_batch_bytes);
    ahead += batch.size();
  }
  CHECK(ahead + split.rest.size() == commands.size());
  REQUIRE(split.rest.size() == 4);
  CHECK(std::holds_alternative<NodeCreate>(split.rest[0]));
  CHECK(split.rest[3] == Command(HideSet{9, true}));
  CHECK(split.rest_from.back() == commands.size() - 1);
}

TEST_CASE("of more commands than a batch may have the contents go ahead in batches that may be sent") {
  constexpr std::size_t fragments = 2 * replication::most_changes_of_batch;
  std::vector<Command> commands{NodeCreate{1, NodeType::material}};
  for (std::size_t i = 0; i < fragments; ++i)
    commands.emplace_back(FragmentSet{1, static_cast<FragmentId>(i % 100), ColorFragment{}});
  commands.insert(commands.end(), {NodeCreate{2, NodeType::object}, LinkSet{2, 0, {"material", 1, 0}}});
  const SplitBatch split = split_content(commands);
  REQUIRE(split.ahead.size() == 3);
  std::size_t ahead = 0;
  for (const auto& batch : split.ahead) {
    CHECK(batch.size() <= replication::most_changes_of_batch);
    ahead += batch.size();
  }
  CHECK(ahead == fragments + 1);
  CHECK(split.rest.size() == 2);
}

TEST_CASE(
    "a large shape reaches its size in batches that each let it grow by less than a batch may, with all its values") {
  constexpr std::uint32_t vertices = 300'000, polygons = 500'000;
  std::vector<Command> commands;
  for (const NodeId id : {1u, 2u}) {
    commands.insert(commands.end(), {NodeCreate{id, NodeType::geometry}, GeometrySizeSet{id, vertices, polygons},
                                     GeometryLayerSet{id, 5, "map_u", LayerType::corner_real, 0, 0.0}});
    for (std::uint32_t first = 0; first < vertices; first += 50'000)
      commands.emplace_back(VerticesSet{id, first, std::vector<glm::vec3>(50'000, glm::vec3(1.0f * id))});
  }
  const SplitBatch split = split_content(commands);
  CHECK(split.rest.empty());
  Store whole, stepped;
  for (const Command& command : commands) REQUIRE(whole.apply(command).has_value());
  for (const auto& batch : split.ahead) {
    CHECK(grown_bytes(stepped, batch) <= replication::most_grown_bytes_of_batch);
    for (const Command& command : batch) REQUIRE(stepped.apply(command).has_value());
  }
  CHECK(same_content(stepped, whole));
}

TEST_CASE("a size alone may make a large shape, and goes ahead too") {
  const SplitBatch split = split_content(
      std::vector<Command>{NodeCreate{1, NodeType::geometry}, GeometrySizeSet{1, 1'000'000, 1}, HideSet{9, true}});
  CHECK(split.ahead.size() > 2);
  CHECK(split.rest == std::vector<Command>{HideSet{9, true}});
}

}  // namespace septet::editor

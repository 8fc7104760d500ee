#include "engine/editor/content_ahead.hpp"

#include <cstddef>
#include <variant>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/bytes.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/command_codec.hpp"

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

}  // namespace septet::editor

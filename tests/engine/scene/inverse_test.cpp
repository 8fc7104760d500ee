#include "engine/scene/inverse.hpp"

#include <doctest/doctest.h>

#include "tests/engine/scene/sample_commands.hpp"

using namespace septet;
using namespace septet::scene;

namespace {

Store filled() {
  Store store;
  for (const Command& command : sample_commands())
    if (command.index() >= 3) must_apply(store, command);
  return store;
}

}  // namespace

TEST_CASE("every command is undone by its inverse, in a filled store and while it is filled") {
  Store growing;
  std::size_t undone = 0;
  for (const Command& command : sample_commands()) {
    for (const Store& start : {growing, filled()}) {
      CAPTURE(name_of(command));
      const std::vector<Command> undo = inverse_of(start, command);
      Store changed = start;
      if (!changed.apply(command)) continue;
      if (!same_content(start, changed)) ++undone;
      for (const Command& each : undo) must_apply(changed, each);
      CHECK(same_content(start, changed));
      CHECK(changed.content_bytes() == start.content_bytes());
    }
    (void)growing.apply(command);  // Subscriptions are refused.
  }
  CHECK(undone > 30);
}

TEST_CASE("what a command cuts off comes back with its inverse") {
  const Store before = filled();
  Store store = before;
  for (const auto& entry : before.nodes()) {
    const NodeId id = entry.first;
    const std::vector<Command> cuts = {NodeDestroy{id},
                                       GeometrySizeSet{id, 1, 0},
                                       BitmapSizeSet{id, 1, 1, 1},
                                       GeometryLayerDestroy{id, 0},
                                       BitmapLayerDestroy{id, 0},
                                       TagGroupDestroy{id, 0},
                                       GeometryLayerSet{id, 0, "other", LayerType::face_real, 0, 0.5f},
                                       BitmapLayerSet{id, 0, "other", PixelType::real64}};
    for (const Command& cut : cuts) {
      CAPTURE(id);
      CAPTURE(name_of(cut));
      const std::vector<Command> undo = inverse_of(store, cut);
      if (!store.apply(cut)) continue;
      for (const Command& each : undo) must_apply(store, each);
      CHECK(same_content(store, filled()));
    }
  }
}

TEST_CASE("a batch of which one command is refused changes nothing, and one that is taken can be undone") {
  Store store = filled();
  const std::vector<Command> bad = {NodeCreate{900, NodeType::object}, HideSet{900, true}, HideSet{1, true},
                                    NodeDestroy{2}, TransformSet{77777, {}}};
  const auto refused = apply_whole(store, bad);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().index == 4);
  CHECK(refused.error().why.what.find("there is no such node") != std::string::npos);
  CHECK(same_content(store, filled()));

  std::vector<std::size_t> refusals, forbidden;
  try_each(
      store, bad, [](std::size_t index) { return index == 0; },
      [&](std::size_t index, const Error* why) { (why ? refusals : forbidden).push_back(index); });
  CHECK(forbidden == std::vector<std::size_t>{0});
  CHECK(refusals == std::vector<std::size_t>{1, 4});
  CHECK(same_content(store, filled()));

  const auto undo = apply_whole(store, std::span(bad).first(4));
  REQUIRE(undo.has_value());
  CHECK(store.find(900));
  CHECK_FALSE(store.find(2));
  REQUIRE(apply_whole(store, *undo).has_value());
  CHECK(same_content(store, filled()));
}

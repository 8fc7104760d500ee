#include "logging/session/recorded_scene.hpp"

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/logging/scene_edit.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
TEST_CASE("a recorded scene changes at the ticks of its edits, forwards and from the beginning again") {
  const TemporaryFolder folder;
  const auto path = folder / "session.sqlite";
  {
    SessionWriter writer = must_create(path);
    writer.record(edit_of(0, scene::NodeCreate{1, scene::NodeType::object}));
    writer.record(edit_of(12, scene::HideSet{1, true}));
    writer.record(edit_of(12, scene::NodeNameSet{1, "gone"}));
    writer.record(edit_of(30, scene::NodeDestroy{1}));
    REQUIRE(writer.finish());
  }
  const SessionReader reader = must_open(path);
  auto recorded = RecordedScene::open(reader);
  REQUIRE(recorded.has_value());
  scene::Store store;
  const auto hidden = [&] { return std::get<scene::ObjectData>(store.find(1)->data).hidden; };
  std::vector<scene::Command> applied;
  const auto note = [&](const scene::Command& command) { applied.push_back(command); };
  REQUIRE(recorded->advance(11, store, note));
  CHECK_FALSE(hidden());
  REQUIRE(recorded->advance(12, store, note));
  CHECK(hidden());
  CHECK(store.find(1)->name == "gone");
  CHECK(applied.size() == 3);
  CHECK(recorded->is_past(11));
  CHECK_FALSE(recorded->is_past(12));
  REQUIRE(recorded->advance(30, store));
  CHECK_FALSE(store.find(1));
  recorded->begin_anew();
  store = scene::Store();
  REQUIRE(recorded->advance(29, store));
  CHECK(hidden());
}

}  // namespace septet::logging

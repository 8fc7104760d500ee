#include "sim-server/drive/world_gate.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <doctest/doctest.h>

#include "engine/scene/builder.hpp"
#include "engine/scene/pushable_box.hpp"
#include "engine/world/solid.hpp"
#include "sim-server/drive/operated.hpp"
#include "tests/sim-server/shipped_drive.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

using scene::Command;
using scene::NodeId;

constexpr NodeId labs_ids = 1'000'000, guests_ids = 2'000'000;

/// A drive with a tree and a house in its scene, and two editors.
struct Gate {
  OpenedDrive opened{.loaded = shipped_drive("behind-ambulance", "desktop"), .store = scene::Store()};
  NodeId tree = scene::SceneBuilder(opened.store).add_object("tree/1", {});
  NodeId house = scene::SceneBuilder(opened.store).add_object("town house/1/2", {});
  Editor lab{"lab", {}, labs_ids}, guest{"guest", {}, guests_ids};
  std::unique_ptr<LiveDrive> live;
  std::optional<WorldGate> world;
  std::vector<std::pair<Tick, Command>> told;

  Gate() {
    const auto& model = opened.loaded.model;
    auto started = LiveDrive::start(model, traffic::own_traffic(model->roads, 1), {});
    REQUIRE_MESSAGE(started.has_value(), why_not(started));
    live = std::move(*started);
    opened.live = live.get();
    world.emplace(opened);
    world->tell([this](const Command& command, Tick from) { told.emplace_back(from, command); });
    world->begin();
  }
  bool is_hidden(NodeId node) const { return std::get<scene::ObjectData>(opened.store.find(node)->data).hidden; }
  /// Why it is refused, or nothing.
  std::string make(const Editor& editor, std::vector<Command> batch, bool may_be_undone = true) {
    const auto refused = world->make(editor, std::move(batch), 5, may_be_undone);
    return refused ? refused->failures.front().why : "";
  }
  std::string undo(const Editor& editor) {
    const auto refused = world->undo(editor, 6);
    return refused ? refused->failures.front().why : "";
  }
  std::string command(const std::string& text, const Author& author) {
    const auto done = do_command(text, author, 7, *world);
    return done ? "" : done.error().what;
  }
};

}  // namespace

TEST_CASE("who sets a fragment that is a constant here is told once and not refused") {
  Gate gate;
  const NodeId glass = scene::SceneBuilder(gate.opened.store).add_material("glass", {});
  gate.world->take_messages();
  const Command view = scene::FragmentSet{glass, 90, scene::ViewFragment{}};
  CHECK(gate.make(gate.lab, {view, scene::FragmentSet{glass, 91, scene::ColorFragment{}}}) == "");
  CHECK(gate.world->take_messages() ==
        std::vector<std::string>{"lab has set material glass, fragment 90, view: 0.5 in each channel"});
  CHECK(gate.make(gate.lab, {view}) == "");
  CHECK(gate.world->take_messages().empty());
}

TEST_CASE("a batch whose sizes let shapes grow by more than a tick has time for is refused with both figures") {
  Gate gate;
  const auto sized = [&](std::uint32_t vertices, std::uint32_t polygons) {
    return gate.make(gate.lab, {scene::NodeCreate{labs_ids, scene::NodeType::geometry},
                                scene::GeometrySizeSet{labs_ids, vertices, polygons}});
  };
  CHECK(sized(4'000'000, 4'000'000).find("4000000 vertices and 4000000 polygons, of each 1048576") !=
        std::string::npos);
  CHECK(sized(10, 300'000).find("grow by 4800120 bytes") != std::string::npos);
  CHECK_FALSE(gate.opened.store.find(labs_ids));
  CHECK(sized(10, 250'000) == "");
  CHECK(gate.make(gate.lab, {scene::GeometrySizeSet{labs_ids, 10, 500'000}}) == "");
  // What an undo brings back was there.
  CHECK(gate.make(gate.lab, {scene::NodeDestroy{labs_ids}}) == "");
  CHECK(gate.undo(gate.lab) == "");
  CHECK(gate.opened.store.find(labs_ids));
}

TEST_CASE("an editor's newest batch is undone, then the one before it, and then there is nothing to be undone") {
  Gate gate;
  const scene::Store before = gate.opened.store;
  CHECK(gate.undo(gate.lab) == "there is nothing of lab's to be undone");
  CHECK(gate.make(gate.lab, {scene::HideSet{gate.tree, true}}) == "");
  CHECK(gate.make(gate.lab,
                  {scene::NodeCreate{labs_ids, scene::NodeType::object}, scene::NodeNameSet{labs_ids, "stimuli/ball"},
                   scene::TransformSet{labs_ids, {{1.0, 2.0, 3.0}}}}) == "");
  CHECK(gate.make(gate.lab, {scene::NodeDestroy{labs_ids}}) == "");
  const Editor later{"lab", {}, guests_ids + 65536};  // The same key, connected again with other ids.
  CHECK(gate.undo(later) == "");
  REQUIRE(gate.opened.store.find(labs_ids));
  CHECK(gate.opened.store.find(labs_ids)->name == "stimuli/ball");
  CHECK(gate.told.back().first == 6);
  // It is lab's again, and nobody else's.
  CHECK(gate.make(gate.guest, {scene::HideSet{labs_ids, true}}).find("which lab made") != std::string::npos);
  CHECK(gate.undo(gate.guest) == "there is nothing of guest's to be undone");
  CHECK(gate.undo(later) == "");
  CHECK_FALSE(gate.opened.store.find(labs_ids));
  CHECK(gate.undo(later) == "");
  CHECK(scene::same_content(gate.opened.store, before));
  CHECK(gate.undo(later) == "there is nothing of lab's to be undone");
}

TEST_CASE("what somebody else has changed since, or what an editor may no longer do, is not undone") {
  Gate gate;
  CHECK(gate.make(gate.lab, {scene::HideSet{gate.house, true}}) == "");
  CHECK(gate.make(gate.lab, {scene::HideSet{gate.tree, true}}) == "");
  CHECK(gate.make(gate.guest, {scene::TransformSet{gate.tree, {{9.0, 0.0, 0.0}}}}) == "");
  CHECK(gate.undo(gate.lab) == "guest has changed tree/1 since");
  CHECK(gate.is_hidden(gate.tree));
  Editor only_moves = gate.lab;
  only_moves.rights.kinds = 1u << static_cast<int>(net::EditKind::move);
  CHECK(gate.undo(only_moves).find("may not hide") != std::string::npos);
  CHECK(gate.is_hidden(gate.house));
  // A removal that was named ahead is not the newest thing that an editor did.
  CHECK(gate.make(gate.lab, {scene::HideSet{gate.tree, false}}, false) == "");
  CHECK(gate.undo(gate.lab) == "there is nothing of lab's to be undone");
}

TEST_CASE("a refusal about a node that is gone has the name that it had") {
  Gate gate;
  CHECK(gate.make(gate.lab, {scene::NodeCreate{labs_ids, scene::NodeType::object},
                             scene::NodeNameSet{labs_ids, "stimuli/flash"}}) == "");
  CHECK(gate.make(gate.lab, {scene::NodeDestroy{labs_ids}}, false) == "");
  CHECK(gate.undo(gate.lab) == "stimuli/flash is gone: it was removed or replaced");
  const auto refused = gate.world->make(gate.lab, {scene::TransformSet{labs_ids, {}}}, 5);
  REQUIRE(refused);
  CHECK(refused->failures.front().node == "stimuli/flash");
}

TEST_CASE("of many batches the newest hundred are undone") {
  Gate gate;
  for (std::size_t i = 0; i <= most_undone_batches; ++i)
    CHECK(gate.make(gate.lab, {scene::HideSet{gate.tree, i % 2 == 0}}) == "");
  for (std::size_t i = 0; i < most_undone_batches; ++i) CHECK(gate.undo(gate.lab) == "");
  CHECK(gate.undo(gate.lab) == "there is nothing of lab's to be undone");
  CHECK(gate.is_hidden(gate.tree));
}

TEST_CASE("page, storyboard and keys change the scene by one text through one gate, each with its own rights") {
  Gate gate;
  const Author page{"Anna", the_page()}, operates{"desk", std::nullopt}, lab{"lab", gate.lab};
  CHECK(gate.command("scene hide-set \"town house/1/2\" 1", page) == "");
  CHECK(gate.is_hidden(gate.house));
  CHECK(gate.told.back().first == 7);
  CHECK(gate.command("undo", page) == "");
  CHECK_FALSE(gate.is_hidden(gate.house));
  CHECK(gate.command("undo", page) == "there is nothing of the operator's page's to be undone");
  CHECK(gate.command("scene hide-set tree/1 1", lab) == "");
  CHECK(gate.command("scene hide-set tree/1 0", operates) == "this key may operate, not edit");
  CHECK(gate.command("undo", operates) == "this key may operate, not edit");
  CHECK(gate.is_hidden(gate.tree));
  for (const char* wrong : {"scene ", "scene jump tree/1", "scene hide-set nobody 1", "scene hide-set tree/1 2",
                            "scene node-create #7 object", "call name=scene command=x", "call name=lift node=nobody"})
    CHECK_MESSAGE(gate.command(wrong, page) != "", wrong);
  // The page reaches what an editor made.
  CHECK(gate.make(gate.lab, {scene::NodeCreate{labs_ids, scene::NodeType::object},
                             scene::NodeNameSet{labs_ids, "stimuli/ball"}}) == "");
  CHECK(gate.command("scene hide-set stimuli/ball 1", page) == "");
  const auto done = gate.world->make_line(the_storyboard(), "transform-set tree/1 4 5 6", 8);
  REQUIRE_MESSAGE(done.has_value(), why_not(done));
  CHECK(gate.told.back().first == 8);
}

TEST_CASE("a solid with a mass has its box in tags from the tick that shows its batch, and is undone whole") {
  Gate gate;
  const NodeId mesh = labs_ids, crate = labs_ids + 1;
  const std::vector<Command> batch{
      scene::NodeCreate{mesh, scene::NodeType::geometry},
      scene::GeometrySizeSet{mesh, 4, 1},
      scene::VerticesSet{mesh, 0, {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 1}}},
      scene::PolygonsSet{mesh, 0, {{0, 1, 2, 3}}},
      scene::NodeCreate{crate, scene::NodeType::object},
      scene::NodeNameSet{crate, "stimuli/crate"},
      scene::LinkSet{crate, 0, {"geometry", mesh, 0}},
      scene::TransformSet{crate, {{3e4, 3e4, 5.0}}},
      scene::TagGroupSet{crate, 3, "body"},
      scene::TagSet{crate, 3, 0, {"solid", true}},
      scene::TagSet{crate, 3, 1, {"mass_kg", 25.0}},
  };
  REQUIRE(gate.make(gate.lab, batch) == "");
  CHECK(gate.told.size() == batch.size() + 2);
  CHECK(gate.told.back().first == 5);
  const auto box = scene::pushable_box(*gate.opened.store.find(crate));
  REQUIRE(box.has_value());
  CHECK(box->participant == first_solid_participant);
  CHECK(box->foot_m == Vec3(1.0, 0.5, 0.0));
  CHECK(gate.live->state().bodies.bodies.size() == 1);
  CHECK(gate.undo(gate.lab) == "");
  CHECK_FALSE(gate.opened.store.find(crate));
  CHECK(gate.live->state().bodies.empty());
}

}  // namespace septet::server

#include "sim-server/drive/placing.hpp"

#include <cmath>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "engine/geometry/mesh_builder.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/edit_file.hpp"
#include "sim-server/drive/operated.hpp"
#include "sim-server/drive/stock_things.hpp"
#include "tests/relative.hpp"
#include "tests/sim-server/shipped_drive.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

geometry::PolygonMesh slab() {
  geometry::MeshBuilder builder;
  builder.patch({-2, -1, 0}, {2, -1, 0}, {2, 1, 1}, {-2, 1, 1});
  return builder.take();
}

/// A drive whose world has a vehicle's prototype, a tree and a piece of land, and the operator's map.
struct PlacingSite {
  TemporaryFolder folder;
  OpenedDrive opened{.loaded = shipped_drive("behind-ambulance", "desktop"), .store = scene::Store()};
  scene::NodeId tree = scene::no_node;
  std::unique_ptr<LiveDrive> live;
  std::optional<WorldGate> gate;
  std::optional<Placing> placing;

  PlacingSite() {
    scene::SceneBuilder build(opened.store);
    const scene::NodeId shape = build.add_mesh("oak", slab());
    build.add_child(build.add_prototype("hatchback"), build.add_object("hatchback/body near", {.geometry = shape}));
    tree = build.add_object("tree/5000.0/10.0", {.geometry = shape});
    build.apply(scene::TransformSet{tree, {{5000.0, 10.0, 0.0}}});
    build.add_object("land/0.0/0.0", {.geometry = shape});
    opened.generated = opened.store;
    const auto& model = opened.loaded.model;
    auto started = LiveDrive::start(model, traffic::own_traffic(model->roads, 1), {});
    REQUIRE_MESSAGE(started.has_value(), why_not(started));
    live = std::move(*started);
    opened.live = live.get();
    gate.emplace(opened);
    gate->begin();
    std::ofstream(folder / "ball.glb") << "no model";
    std::ofstream(folder / "note.txt") << "no model";
    placing.emplace(*gate, *model, std::vector{folder.path()}, folder.path());
  }
  std::string take(const std::string& lines) {
    const auto done = placing->take(lines, 5);
    return done ? "" : done.error().what;
  }
  const scene::Node* object(const std::string& name) const { return opened.store.find(scene::NodeType::object, name); }
};

}  // namespace

TEST_CASE("the map's stock is the catalogue's vehicles and single things that stand in the world, not the land") {
  const PlacingSite site;
  const auto facts = site.placing->facts();
  REQUIRE(facts.stock.size() == 2);
  CHECK(facts.stock[0].kind == "tree");
  CHECK(facts.stock[0].name == "oak");
  CHECK(facts.stock[0].length_m == doctest::Approx(4.0));
  CHECK(facts.stock[1].kind == "vehicle");
  CHECK(facts.stock[1].node == "model/hatchback");
  CHECK(facts.own_models == std::vector<std::string>{"ball.glb"});
}

TEST_CASE("a thing of the stock is placed on the ground and solid in one batch, which one undo takes back") {
  PlacingSite site;
  const Vec2 beside(site.live->first()->snapshot().participants.front().world_from_vehicle.position_m.x + 300.0, 300.0);
  CHECK(site.take(fmt::format("like \"placed/car/1\" model/hatchback {} {} ground 90\nsolid \"placed/car/1\"", beside.x,
                              beside.y)) == "");
  const scene::Node* made = site.object("placed/car/1");
  REQUIRE(made);
  CHECK(std::get<scene::ObjectData>(made->data).transform.position_m.z ==
        relative(std::round(1000.0 * ground_m(*site.opened.loaded.model, beside)) / 1000.0, 1e-9));
  CHECK(scene::is_tagged_solid(*made));
  CHECK(made->id >= page_ids);
  CHECK_FALSE(site.gate->undo(the_page(), 6).has_value());
  CHECK(scene::same_content(site.opened.store, *site.opened.generated));
}

TEST_CASE("the map's lines name no file but the drive's own models, and are no others than it knows") {
  PlacingSite site;
  CHECK(site.take("import x /etc/passwd 0 0 0") == "no file of this name lies in the drive's folders");
  CHECK(site.take("import x ../ball.glb 0 0 0") == "no file of this name lies in the drive's folders");
  CHECK(site.take("import x note.txt 0 0 0") == "no file of this name lies in the drive's folders");
  CHECK(site.take("import x ball.glb 0 0 0").find("no file of this name") == std::string::npos);
  for (const char* line : {"picture tree/5000.0/10.0 /etc/passwd", "node-create +0 object", "undo", "save x", "#"})
    CHECK_MESSAGE(site.take(line) == "the map knows no such line", line);
  // All or none.
  CHECK(site.take("hide tree/5000.0/10.0\nhide nobody") != "");
  CHECK(scene::same_content(site.opened.store, *site.opened.generated));
}

TEST_CASE("what was placed and what of the world is otherwise is listed, anew when it has changed") {
  PlacingSite site;
  const auto none = site.placing->view();
  CHECK(none->things.empty());
  CHECK(site.placing->view() == none);
  REQUIRE(site.take("like \"placed/car/1\" model/hatchback 5010 10 2 30\nhide tree/5000.0/10.0") == "");
  const auto two = site.placing->view();
  REQUIRE(two->things.size() == 2);
  CHECK(two->things[0].name == "placed/car/1");
  CHECK(two->things[0].was_placed);
  CHECK(two->things[0].heading_deg == doctest::Approx(30.0));
  CHECK(two->things[0].length_m == doctest::Approx(4.0));
  CHECK_FALSE(two->things[1].was_placed);
  CHECK_FALSE(two->things[1].is_shown);
  CHECK(site.placing->view() == two);
  REQUIRE(site.take("show tree/5000.0/10.0") == "");
  CHECK(site.placing->view()->things.size() == 1);
}

TEST_CASE("what stands near a click is found, the nearest first, as far as it is a single thing") {
  PlacingSite site;
  REQUIRE(site.take("like \"placed/car/1\" model/hatchback 5006 10 2") == "");
  const auto found = site.placing->near({5001.0, 10.0}, 10.0);
  REQUIRE(found.size() == 2);
  CHECK(found[0].id == site.tree);
  CHECK(found[1].name == "placed/car/1");
  CHECK(site.placing->near({5001.0, 10.0}, 2.0).size() == 1);
  CHECK(site.placing->near({0.0, 0.0}, 10.0).empty());
}

TEST_CASE(
    "what differs is saved in the drive's folder under a name that is no path, and another world becomes the same by "
    "it") {
  PlacingSite site;
  REQUIRE(site.take("like \"placed/car/1\" model/hatchback 5010 10 2 30\nsolid \"placed/car/1\"") == "");
  REQUIRE(site.take("move tree/5000.0/10.0 5001 11 0 45") == "");
  for (const char* bad : {"", "../x", "a/b", "a b", "a.edits"}) CHECK_FALSE(site.placing->save(bad).has_value());
  const auto file = site.placing->save("my-town");
  REQUIRE_MESSAGE(file.has_value(), why_not(file));
  CHECK(*file == site.folder / "my-town.edits");
  const std::string text = read_regular_file(*file).value();
  scene::Store again = *site.opened.generated;
  REQUIRE(scene::apply_edits(again, text, "my-town.edits").has_value());
  CHECK(scene::edits_between(*site.opened.generated, again) == text);
}

}  // namespace septet::server

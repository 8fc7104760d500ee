#include "sim-server/drive/standing_things.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/physics/vehicle/vehicle.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/simulation/saved_state.hpp"
#include "engine/simulation/server_step.hpp"
#include "sim-server/drive/scene_gate.hpp"
#include "tests/sim-server/shipped_drive.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

using scene::Command;

constexpr scene::NodeId tree_mesh = 10, tree_object = 11, stranger = 12;

const simulation::Model& motorway_model() {
  static const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  return *drive.model;
}

/// A tree with a road near it and nothing else around.
const Obstacle& lone_tree() {
  const auto& model = motorway_model();
  const auto listed = model.obstacles->listed();
  const auto found = std::ranges::find_if(listed, [&](const Obstacle& obstacle) {
    return obstacle.kind == ObstacleKind::tree && obstacle.thing != 0 &&
           model.obstacles->near(obstacle.from_m, 16.0).size() == 1 &&
           road::locate(model.roads, obstacle.from_m, nullptr, 60.0);
  });
  REQUIRE(found != listed.end());
  return *found;
}

/// The driver's car alone, seven metres before a tree at 10 m/s, in a world of that tree and of something elsewhere.
struct TreeSite {
  const simulation::Model& model = motorway_model();
  const Obstacle& tree = lone_tree();
  Vec3 foot_m{tree.from_m, 0.0};
  simulation::State state;
  scene::Store store;
  StandingThings things;
  std::vector<simulation::Event> events;
  std::vector<std::pair<Tick, std::string>> logged;

  explicit TreeSite(double before_m = 7.0) {
    auto begun = simulation::initial_state(model, traffic::own_traffic(model.roads, 1));
    REQUIRE_MESSAGE(begun.has_value(), why_not(begun));
    state = std::move(*begun);
    state.traffic->stop();
    const Vec2 ahead(std::cos(0.3), std::sin(0.3)), origin_m = tree.from_m - before_m * ahead;
    state.car = vehicle::standstill(
        model.car,
        {Vec3(origin_m, model.obstacles->terrain().height_m(origin_m)), orientation_from_angles(0.3, 0.0, 0.0)}, 10.0);
    state.car_road.reset();
    for (const Command& command : std::vector<Command>{
             scene::NodeCreate{tree_mesh, scene::NodeType::geometry},
             scene::NodeCreate{tree_object, scene::NodeType::object}, scene::NodeNameSet{tree_object, "tree/1.0/2.0"},
             scene::LinkSet{tree_object, 0, {"geometry", tree_mesh, 0}}, scene::TransformSet{tree_object, {foot_m}},
             scene::NodeCreate{stranger, scene::NodeType::object},
             scene::LinkSet{stranger, 0, {"geometry", tree_mesh, 0}},
             scene::TransformSet{stranger, {foot_m + Vec3(0.1, 0.0, 0.0)}}})
      REQUIRE(store.apply(command).has_value());
    things = StandingThings(store, *model.obstacles);
  }

  /// Why the batch is refused, or nothing.
  std::string make(const std::vector<Command>& batch) {
    for (const Command& command : batch) REQUIRE(store.apply(command).has_value());
    const auto commands = things.change(store, batch, model, state);
    if (!commands) return commands.error().why;
    for (const simulation::OperatorCommand& command : *commands) {
      const auto done = simulation::apply_operator_command(model, command, state, events);
      REQUIRE_MESSAGE(done.has_value(), why_not(done));
      logged.emplace_back(state.tick + 1, simulation::text_of(command));
    }
    return {};
  }
  void drive(double time_s) {
    for (int tick = 0; tick < static_cast<int>(time_s * simulation::tick_rate_hz); ++tick)
      simulation::server_step(model, {}, state, events);
  }
  std::size_t met() const {
    return static_cast<std::size_t>(std::ranges::count(events, "collision", &simulation::Event::kind));
  }
};

}  // namespace

TEST_CASE("a tree that an editor hides, moves or destroys is met no more, and one that is drawn is met") {
  const std::vector<std::vector<Command>> changes{
      {},
      {scene::HideSet{stranger, true}},
      {scene::HideSet{tree_object, true}},
      {scene::TransformSet{tree_object, {Vec3(0.0, 0.0, 500.0)}}},
      {scene::NodeDestroy{tree_object}},
      {scene::HideSet{tree_object, true}, scene::HideSet{tree_object, false}},
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    CAPTURE(i);
    const bool is_gone = i >= 2 && i <= 4;
    TreeSite site;
    REQUIRE(site.make(changes[i]).empty());
    CHECK(site.logged.size() == (is_gone ? 1 : 0));
    if (is_gone) {
      CHECK(site.logged.front().second.starts_with("gone x_m="));
      CHECK(site.logged.front().second.ends_with(" name=\"tree/1.0/2.0\""));
    }
    site.drive(1.0);
    CHECK(site.met() == (is_gone ? 0 : 1));
    CHECK(site.state.diagnostics.bad_numbers == 0);
  }
}

TEST_CASE("a tree that is shown again is met again, but is not shown where the driver's car is") {
  TreeSite site;
  REQUIRE(site.make({scene::HideSet{tree_object, true}}).empty());
  site.drive(0.1);
  REQUIRE(site.make({scene::HideSet{tree_object, false}}).empty());
  site.drive(0.9);
  CHECK(site.met() == 1);

  TreeSite within(1.0);
  REQUIRE(within.make({scene::HideSet{tree_object, true}}).empty());
  CHECK(within.make({scene::HideSet{tree_object, false}}).find("the driver's car is there") != std::string::npos);
  CHECK(within.state.gone.size() == 1);
}

TEST_CASE("a drive without a tree is the same again by its logged commands, and from its saved state") {
  TreeSite site;
  REQUIRE(site.make({scene::HideSet{tree_object, true}}).empty());
  site.drive(0.2);
  const auto bytes = simulation::save_state(site.model, site.state);
  REQUIRE_MESSAGE(bytes.has_value(), why_not(bytes));
  site.drive(0.5);

  TreeSite again;
  CHECK(simulation::hash_state(again.state) != simulation::hash_state(site.state));
  for (const auto& [before, text] : site.logged) {
    const auto command = simulation::parse_operator_command(text);
    REQUIRE_MESSAGE(command.has_value(), why_not(command));
    CHECK(simulation::text_of(*command) == text);
    REQUIRE(simulation::apply_operator_command(again.model, *command, again.state, again.events).has_value());
    CHECK_FALSE(simulation::apply_operator_command(again.model, *command, again.state, again.events).has_value());
  }
  while (again.state.tick < site.state.tick) simulation::server_step(again.model, {}, again.state, again.events);
  CHECK(simulation::hash_state(again.state) == simulation::hash_state(site.state));

  auto kept = simulation::restore_state(site.model, traffic::own_traffic(site.model.roads, 1), *bytes, "state");
  REQUIRE_MESSAGE(kept.has_value(), why_not(kept));
  while (kept->tick < site.state.tick) simulation::server_step(site.model, {}, *kept, again.events);
  CHECK(simulation::hash_state(*kept) == simulation::hash_state(site.state));
}

TEST_CASE(
    "things that a file of edits hides are gone at a drive's beginning, and what an earlier log left comes back") {
  TreeSite site;
  REQUIRE(site.store.apply(scene::HideSet{tree_object, true}).has_value());
  std::vector<std::string> messages;
  auto commands = site.things.begin(site.store, site.model, site.state, messages);
  REQUIRE(commands.size() == 1);
  REQUIRE(simulation::apply_operator_command(site.model, commands.front(), site.state, site.events).has_value());
  CHECK(site.things.begin(site.store, site.model, site.state, messages).empty());
  REQUIRE(site.store.apply(scene::HideSet{tree_object, false}).has_value());
  commands = site.things.begin(site.store, site.model, site.state, messages);
  REQUIRE(commands.size() == 1);
  CHECK(std::get<simulation::ShowStanding>(commands.front()).shown);
  CHECK(messages.empty());
}

TEST_CASE("a text that hides a standing thing has a place and a name and no more, and a place where one stands") {
  const TreeSite site;
  const std::string good =
      simulation::text_of(simulation::ShowStanding{site.tree.from_m.x, site.tree.from_m.y, false, "tree/a b x_m=1"});
  REQUIRE(simulation::parse_operator_command(good).has_value());
  CHECK(simulation::text_of(*simulation::parse_operator_command(good)) == good);
  for (const char* text : {"gone ", "gone x_m=1", "gone x_m=1 y_m=nan", "gone x_m=1 y_m=inf", "gone y_m=1 x_m=1",
                           "gone x_m=1 y_m=1 z_m=1", "gone x_m=1 y_m=1 ", "gone x_m=1 y_m=1 name=\"a",
                           "gone x_m=1 y_m=1 name=\"a\"b\"", "back x_m=1 y_m=1 name=\"a\nb\""})
    CHECK_MESSAGE(!simulation::parse_operator_command(text).has_value(), text);
  for (const auto& [x_m, y_m] : {std::pair(site.foot_m.x + 0.01, site.foot_m.y), std::pair(1e300, 0.0)})
    CHECK_FALSE(simulation::may_show(site.model, site.state, {x_m, y_m, false, ""}).has_value());
}

}  // namespace septet::server

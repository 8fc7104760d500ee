#include "sim-server/drive/solid_things.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/physics/vehicle/vehicle.hpp"
#include "engine/scene/builder.hpp"
#include "engine/simulation/saved_state.hpp"
#include "engine/simulation/server_step.hpp"
#include "sim-server/drive/scene_gate.hpp"
#include "tests/relative.hpp"
#include "tests/sim-server/shipped_drive.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

using scene::Command;
using scene::NodeId;

constexpr NodeId own_ids = 1'000'000;
constexpr NodeId wall = own_ids, wall_mesh = own_ids + 1;

const LoadedDrive& motorway() {
  static const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  return drive;
}

/// The driver's car alone on the motorway at 20 m/s, and an editor.
struct Site {
  const simulation::Model& model = *motorway().model;
  simulation::State state;
  RigidTransform start;  ///< Of the car.
  scene::Store store;
  SolidThings things;
  NodeMakers makers;
  Editor lab{"lab", {}, own_ids};
  std::vector<simulation::Event> events;
  std::vector<std::pair<Tick, std::string>> logged;  ///< Commands, each before its tick.

  Site() {
    auto begun = simulation::initial_state(model, traffic::own_traffic(model.roads, 1));
    REQUIRE_MESSAGE(begun.has_value(), why_not(begun));
    state = std::move(*begun);
    state.traffic->stop();
    for (scenario::EntityState& entity : state.scenario.entities)
      if (!entity.external) entity.active = false;
    state.scenario.entities[model.driver_entity].active = true;
    start = state.scenario.entities[model.driver_entity].world_from_entity;
    state.car = vehicle::standstill(model.car, start, 20.0);
  }

  /// Why the batch is refused, or nothing.
  std::string make(const std::vector<Command>& batch, std::size_t* index = nullptr) {
    SolidChange change;
    const auto refused = pass_gate(
        store, batch, lab, makers, [](const Command&) {},
        [&]() -> std::optional<replication::Failure> {
          auto made = things.change(store, batch, lab, model, state);
          if (!made) return made.error();
          change = std::move(*made);
          return std::nullopt;
        });
    if (refused && index) *index = refused->failures.front().index;
    if (refused) return refused->failures.front().why;
    for (const simulation::OperatorCommand& command : change.commands) {
      const auto done = simulation::apply_operator_command(model, command, state, events);
      REQUIRE_MESSAGE(done.has_value(), why_not(done));
      logged.emplace_back(state.tick + 1, simulation::text_of(command));
    }
    things.take_over(std::move(change));
    return {};
  }

  void drive(double time_s) {
    for (int tick = 0; tick < static_cast<int>(time_s * simulation::tick_rate_hz); ++tick)
      simulation::server_step(model, {}, state, events);
  }
  /// Of the car's start, along its heading.
  RigidTransform ahead(double metres) const { return {start * Vec3(metres, 0.0, 0.0), start.orientation}; }
  double driven_m() const { return glm::distance(state.car.world_from_body.position_m, start.position_m); }
  std::size_t collisions() const {
    return static_cast<std::size_t>(std::ranges::count(events, "collision", &simulation::Event::kind));
  }
};

/// A wall across the road, half a metre thick.
std::vector<Command> wall_at(const RigidTransform& place, bool solid) {
  std::vector<Command> batch{
      scene::NodeCreate{wall_mesh, scene::NodeType::geometry},
      scene::GeometrySizeSet{wall_mesh, 4, 1},
      scene::VerticesSet{wall_mesh, 0, {{0, -4, 0}, {0.5, 4, 0}, {0.5, 4, 2}, {0, -4, 2}}},
      scene::PolygonsSet{wall_mesh, 0, {{0, 1, 2, 3}}},
      scene::NodeCreate{wall, scene::NodeType::object},
      scene::NodeNameSet{wall, "stimuli/wall"},
      scene::LinkSet{wall, 0, {"geometry", wall_mesh, 0}},
      scene::TransformSet{wall, {place.position_m, place.orientation, glm::vec3(1.0f)}},
  };
  if (solid) {
    batch.emplace_back(scene::TagGroupSet{wall, 0, "body"});
    batch.emplace_back(scene::TagSet{wall, 0, 0, {"solid", true}});
  }
  return batch;
}

}  // namespace

TEST_CASE("a wall that an editor tags solid stops the car, and without the tag the car goes through") {
  for (const bool solid : {true, false}) {
    CAPTURE(solid);
    Site site;
    REQUIRE(site.make(wall_at(site.ahead(30.0), solid)).empty());
    site.drive(3.0);
    CHECK(site.logged.size() == (solid ? 1 : 0));
    if (solid) CHECK(site.logged.front().second.ends_with(" name=\"stimuli/wall\""));
    CHECK((site.driven_m() < 30.0) == solid);
    CHECK((glm::length(site.state.car.velocity_mps) < 5.0) == solid);
    CHECK(site.collisions() == (solid ? 1 : 0));
    CHECK(site.state.diagnostics.bad_numbers == 0);
  }
}

TEST_CASE("a solid that is moved, hidden, untagged or destroyed is met no more from that tick on") {
  const std::vector<std::vector<Command>> changes{
      {scene::TransformSet{wall, {{0.0, 0.0, 500.0}}}},
      {scene::HideSet{wall, true}},
      {scene::TagSet{wall, 0, 0, {"solid", false}}},
      {scene::TagDestroy{wall, 0, 0}},
      {scene::TagGroupSet{wall, 0, "other"}},
      {scene::GeometrySizeSet{wall_mesh, 0, 0}},
      {scene::NodeDestroy{wall}, scene::NodeDestroy{wall_mesh}},
  };
  for (const std::vector<Command>& change : changes) {
    CAPTURE(scene::name_of(change.front()));
    Site site;
    REQUIRE(site.make(wall_at(site.ahead(30.0), true)).empty());
    site.drive(0.5);
    REQUIRE(site.make(change).empty());
    CHECK(site.logged.size() == 2);
    CHECK(site.logged.back().first == 61);
    site.drive(2.5);
    CHECK(site.driven_m() > 40.0);
    CHECK(site.collisions() == 0);
  }
}

TEST_CASE("a solid that is shown again or moved to the car's way is met there") {
  Site site;
  REQUIRE(site.make(wall_at({Vec3(0.0, 0.0, 500.0), Quat(1.0, 0.0, 0.0, 0.0)}, true)).empty());
  REQUIRE(site.make({scene::HideSet{wall, true}}).empty());
  const RigidTransform place = site.ahead(30.0);
  REQUIRE(site.make({scene::TransformSet{wall, {place.position_m, place.orientation}}}).empty());
  CHECK_FALSE(simulation::stands(site.state, 0));
  REQUIRE(site.make({scene::HideSet{wall, false}}).empty());
  site.drive(3.0);
  CHECK(site.driven_m() < 30.0);
}

TEST_CASE("a drive with solids is the same again by its logged commands, and from its saved state") {
  Site site;
  REQUIRE(site.make(wall_at(site.ahead(30.0), true)).empty());
  site.drive(1.0);
  const auto bytes = simulation::save_state(site.model, site.state);
  REQUIRE_MESSAGE(bytes.has_value(), why_not(bytes));
  site.drive(1.0);

  Site again;
  for (const auto& [before, text] : site.logged) {
    while (again.state.tick + 1 < before) simulation::server_step(again.model, {}, again.state, again.events);
    const auto command = simulation::parse_operator_command(text);
    REQUIRE_MESSAGE(command.has_value(), why_not(command));
    REQUIRE(simulation::apply_operator_command(again.model, *command, again.state, again.events).has_value());
  }
  while (again.state.tick < site.state.tick) simulation::server_step(again.model, {}, again.state, again.events);
  CHECK(simulation::hash_state(again.state) == simulation::hash_state(site.state));

  auto restored = simulation::restore_state(site.model, traffic::own_traffic(site.model.roads, 1), *bytes, "test");
  REQUIRE_MESSAGE(restored.has_value(), why_not(restored));
  CHECK(simulation::stands(*restored, 0));
  while (restored->tick < site.state.tick) simulation::server_step(site.model, {}, *restored, again.events);
  CHECK(simulation::hash_state(*restored) == simulation::hash_state(site.state));
}

TEST_CASE("a solid that may not be is refused with the command and why, and the scene is as it was") {
  Site site;
  const auto refused = [&](const std::vector<Command>& batch, const std::string& why, std::size_t at) {
    scene::Store before;
    scene::describe_store(site.store, [&](const Command& command) { REQUIRE(before.apply(command).has_value()); });
    std::size_t index = 99;
    const std::string told = site.make(batch, &index);
    CHECK_MESSAGE(told.find(why) != std::string::npos, told);
    CHECK(index == at);
    CHECK(scene::same_content(site.store, before));
  };
  refused(wall_at(site.ahead(1.0), true), "the driver's car is there", 9);
  CHECK_FALSE(simulation::stands(site.state, 0));
  REQUIRE(site.make(wall_at(site.ahead(30.0), true)).empty());
  const simulation::StandSolid stood =
      std::get<simulation::StandSolid>(*simulation::parse_operator_command(site.logged.front().second));
  refused({scene::TransformSet{wall, {{1e9, 0.0, 0.0}}}}, "its x_m is 1e+09", 0);
  refused({scene::TransformSet{wall, {Vec3(0.0), {1, 0, 0, 0}, glm::vec3(1000.0f)}}}, "its length_m is 500", 0);
  scene::MotionSet motion{wall, {}};
  motion.motion.legs.push_back({.velocity_mps = {1.0, 0.0, 0.0}});
  refused({scene::HideSet{wall, false}, motion}, "in motion", 1);
  refused({scene::NodeCreate{own_ids + 2, scene::NodeType::object}, scene::LinkSet{own_ids + 2, 0, {"child", wall, 0}}},
          "it hangs on", 1);
  const auto words = net::read_rights(std::vector<std::string>{"edit", "hide", "move", "paint", "create"});
  site.lab.rights = *words.rights.edit;
  refused({scene::TagSet{wall, 0, 0, {"solid", false}}}, "needs the word solid", 0);
  refused({scene::TagGroupSet{wall, 0, "other"}}, "needs the word solid", 0);
  CHECK(site.logged.size() == 1);
  CHECK(stood.width_m == relative(8.0, 0.01));
}

TEST_CASE("there are no more solids than their number, and one that is gone makes room") {
  Site site;
  REQUIRE(site.make(wall_at(site.ahead(30.0), true)).empty());
  const auto another = [&](NodeId id) {
    return site.make({scene::NodeCreate{id, scene::NodeType::object}, scene::LinkSet{id, 0, {"geometry", wall_mesh, 0}},
                      scene::TransformSet{id, {{0.0, 0.0, 100.0 + 10.0 * (id - own_ids)}}},
                      scene::TagGroupSet{id, 0, "body"}, scene::TagSet{id, 0, 0, {"solid", true}}});
  };
  for (std::uint32_t i = 1; i < most_solids; ++i) REQUIRE(another(own_ids + 1 + i).empty());
  CHECK(another(own_ids + 100).find("64 solids already") != std::string::npos);
  REQUIRE(site.make({scene::NodeDestroy{wall}}).empty());
  CHECK(another(own_ids + 100).empty());
  CHECK(simulation::stands(site.state, 0));
}

TEST_CASE("solids of a file of edits stand at a drive's beginning, and one that may not is told") {
  Site site;
  for (const Command& command : wall_at(site.ahead(30.0), true)) REQUIRE(site.store.apply(command).has_value());
  REQUIRE(site.store.apply(scene::NodeCreate{own_ids + 2, scene::NodeType::object}).has_value());
  REQUIRE(site.store.apply(scene::LinkSet{own_ids + 2, 0, {"geometry", wall_mesh, 0}}).has_value());
  REQUIRE(site.store.apply(scene::TransformSet{own_ids + 2, {site.ahead(1.0).position_m}}).has_value());
  REQUIRE(site.store.apply(scene::TagGroupSet{own_ids + 2, 0, "body"}).has_value());
  REQUIRE(site.store.apply(scene::TagSet{own_ids + 2, 0, 0, {"solid", true}}).has_value());
  std::vector<std::string> messages;
  const SolidChange change = site.things.begin(site.store, site.model, site.state, messages);
  REQUIRE(change.commands.size() == 1);
  CHECK(std::holds_alternative<simulation::StandSolid>(change.commands.front()));
  REQUIRE(messages.size() == 1);
  CHECK(messages.front().find("the driver's car is there") != std::string::npos);
}

}  // namespace septet::server

#include "sim-server/drive/solid_things.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/bytes.hpp"
#include "engine/physics/vehicle/vehicle.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/motion.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/saved_state.hpp"
#include "engine/simulation/server_step.hpp"
#include "engine/simulation/solid_motion.hpp"
#include "engine/world/solid.hpp"
#include "sim-server/drive/motion_times.hpp"
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
  scene::Motion motion_of(NodeId node) const { return std::get<scene::ObjectData>(store.find(node)->data).motion; }
  /// Of the car's start, along its heading.
  RigidTransform ahead(double metres) const { return {start * Vec3(metres, 0.0, 0.0), start.orientation}; }
  double driven_m() const { return glm::distance(state.car.world_from_body.position_m, start.position_m); }
  std::size_t collisions() const {
    return static_cast<std::size_t>(std::ranges::count(events, "collision", &simulation::Event::kind));
  }
};

/// A ball of a metre across (its mesh an octahedron), which rolls about the road's direction from beside the car's way on;
/// `velocity_mps` and places seen from the car's start.
std::vector<Command> ball_at(const Site& site, double ahead_m, double left_m, const Vec3& velocity_mps, double kg) {
  scene::MotionSet rolls{wall, {}};
  rolls.motion.position_m = site.start * Vec3(ahead_m, left_m, 0.5);
  const Vec3 axis = site.start.orientation * Vec3(1.0, 0.0, 0.0);
  const Vec3 level_axis = glm::normalize(Vec3(Vec2(axis), 0.0));
  rolls.motion.legs = {{.velocity_mps = site.start.orientation * velocity_mps, .turn_radps = -6.0 * level_axis}};
  return {
      scene::NodeCreate{wall_mesh, scene::NodeType::geometry},
      scene::GeometrySizeSet{wall_mesh, 6, 1},
      scene::VerticesSet{
          wall_mesh, 0, {{0.5, 0, 0}, {-0.5, 0, 0}, {0, 0.5, 0}, {0, -0.5, 0}, {0, 0, 0.5}, {0, 0, -0.5}}},
      scene::PolygonsSet{wall_mesh, 0, {{0, 2, 4, 5}}},
      scene::NodeCreate{wall, scene::NodeType::object},
      scene::NodeNameSet{wall, "stimuli/ball"},
      scene::LinkSet{wall, 0, {"geometry", wall_mesh, 0}},
      rolls,
      scene::TagGroupSet{wall, 0, "body"},
      scene::TagSet{wall, 0, 0, {"solid", true}},
      scene::TagSet{wall, 0, 1, {"mass_kg", kg}},
  };
}

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

TEST_CASE("a ball that rolls into the car's way is met where it is seen, and gets past it otherwise") {
  for (const bool in_time : {true, false}) {
    CAPTURE(in_time);
    Site site;
    // The car's front comes there in about a second.
    REQUIRE(site.make(ball_at(site, 25.0, in_time ? -3.0 : -30.0, {0.0, 3.0, 0.0}, 200.0)).empty());
    site.drive(2.0);
    CHECK(site.collisions() == (in_time ? 1 : 0));
    const simulation::LooseBody& ball = *simulation::find_loose(site.state, first_solid_participant);
    const RigidTransform drawn = scene::pose_at(site.motion_of(wall), site.state.time_s()).world_from_object;
    const double away_m = glm::distance(ball.body.mass_centre_m, Vec2(drawn.position_m));
    if (!in_time) CHECK(away_m < 1e-6);
    if (in_time) CHECK(away_m > 5.0);
    CHECK(simulation::is_led(site.state, first_solid_participant) == !in_time);
    CHECK(is_free_solid(simulation::participant_of(ball)) == in_time);
    CHECK(site.state.diagnostics.bad_numbers == 0);
  }
}

TEST_CASE("a drive in which a rolling ball is pushed is the same again by its log and from states kept on the way") {
  Site site;
  REQUIRE(site.make(ball_at(site, 25.0, -3.0, {0.0, 3.0, 0.0}, 200.0)).empty());
  std::vector<Bytes> kept;
  // It rolls, it is being pushed, it slides.
  for (const double time_s : {0.5, 0.55, 1.0}) {
    site.drive(time_s);
    auto bytes = simulation::save_state(site.model, site.state);
    REQUIRE_MESSAGE(bytes.has_value(), why_not(bytes));
    kept.push_back(std::move(*bytes));
  }
  site.drive(0.5);
  REQUIRE(site.collisions() == 1);
  REQUIRE_FALSE(simulation::is_led(site.state, first_solid_participant));
  const std::uint64_t hash = simulation::hash_state(site.state);

  const auto driven_again = [&](const std::string& text) {
    Site again;
    const auto command = simulation::parse_operator_command(text);
    REQUIRE_MESSAGE(command.has_value(), why_not(command));
    REQUIRE(simulation::apply_operator_command(again.model, *command, again.state, again.events).has_value());
    while (again.state.tick < site.state.tick) simulation::server_step(again.model, {}, again.state, again.events);
    return simulation::hash_state(again.state);
  };
  REQUIRE(site.logged.size() == 1);
  const std::string text = site.logged.front().second;
  CHECK(driven_again(text) == hash);
  std::string heavier = text, faster = text;
  heavier.replace(heavier.find("mass_kg=200"), 11, "mass_kg=201");
  const std::size_t last_comma = faster.rfind(",0,0,0,0 name=");
  REQUIRE(last_comma != faster.npos);
  faster.replace(last_comma, 2, ",1");
  CHECK(driven_again(heavier) != hash);
  CHECK(driven_again(faster) != hash);

  for (const Bytes& bytes : kept) {
    auto restored = simulation::restore_state(site.model, traffic::own_traffic(site.model.roads, 1), bytes, "test");
    REQUIRE_MESSAGE(restored.has_value(), why_not(restored));
    std::vector<simulation::Event> events;
    while (restored->tick < site.state.tick) simulation::server_step(site.model, {}, *restored, events);
    CHECK(simulation::hash_state(*restored) == hash);
  }
}

TEST_CASE("screens are told the box of what can be pushed, and motion from now on begins where it was pushed to") {
  Site site;
  std::vector<Command> batch = wall_at(site.ahead(30.0), true);
  batch.emplace_back(scene::TagSet{wall, 0, 1, {"mass_kg", 50.0}});
  REQUIRE(site.make(batch).empty());
  const std::vector<Command> tags = site.things.missing_tags(site.store);
  REQUIRE(tags.size() == 2);
  for (const Command& tag : tags) REQUIRE(site.store.apply(tag).has_value());
  CHECK(site.things.missing_tags(site.store).empty());
  const auto box = scene::pushable_box(*site.store.find(wall));
  REQUIRE(box.has_value());
  CHECK(box->participant == first_solid_participant);
  const RigidTransform stood = site.things.pushed_pose(site.store, wall, site.state).value();
  CHECK(glm::distance(stood.position_m, site.ahead(30.0).position_m) < 1e-6);
  site.drive(2.5);
  REQUIRE(site.collisions() >= 1);
  const RigidTransform pushed = site.things.pushed_pose(site.store, wall, site.state).value();
  CHECK(glm::distance(pushed.position_m, stood.position_m) > 3.0);

  std::vector<Command> go{scene::MotionSet{wall, {.legs = {{.velocity_mps = {0.0, 0.0, 1.0}}}}, true}};
  put_true_times(site.store, go, 9.0, [&](NodeId id) { return site.things.pushed_pose(site.store, id, site.state); });
  CHECK(std::get<scene::MotionSet>(go.front()).motion.position_m == pushed.position_m);

  // What is no change of the box leaves it where it is; another mass stands it where the scene has it.
  REQUIRE(site.make({scene::NodeNameSet{wall, "stimuli/other"}}).empty());
  REQUIRE(site.make({scene::TagSet{wall, 0, 9, {"other", true}}}).empty());
  CHECK(site.logged.size() == 1);
  REQUIRE(site.make({scene::TagSet{wall, 0, 1, {"mass_kg", 60.0}}}).empty());
  CHECK(site.logged.size() == 2);
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
  refused({scene::TransformSet{wall, {{1e6, 0.0, 0.0}}}}, "its x_m is 1e+06", 0);
  refused({scene::TransformSet{wall, {Vec3(0.0), {1, 0, 0, 0}, glm::vec3(1000.0f)}}}, "its length_m is 500", 0);
  scene::MotionSet motion{wall, {}};
  motion.motion.legs.push_back({.velocity_mps = {2000.0, 0.0, 0.0}});
  refused({scene::HideSet{wall, false}, motion}, "it moves at 2000 m/s", 1);
  motion.motion = {site.ahead(1.0).position_m, {1.0, 0.0, 0.0, 0.0}, {{.velocity_mps = {1.0, 0.0, 0.0}}}};
  refused({motion}, "the driver's car is there", 0);
  refused({scene::TagSet{wall, 0, 1, {"mass_kg", -1.0}}}, "from 0.1 to 20000 kg", 0);
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

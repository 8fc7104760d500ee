// A scenario's boxes that are hit: pushed by their mass, or met like a wall.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/simulation/bodies/near_pairs.hpp"
#include "engine/world/crash_record.hpp"
#include "engine/world/participant_shape.hpp"
#include "tests/engine/simulation/crash_site.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::simulation;

namespace {

constexpr ParticipantId first_box = first_scripted_participant + 1;

struct Thing {
  Vec3 size_m{0.6, 0.6, 1.1};
  double mass_kg = 15.0;
};

Participant box_at(ParticipantId id, const Vec3& size_m, double x_m, double y_m, double heading_rad = 0.0) {
  Participant box = placed_participant(id, "box", x_m, y_m, heading_rad, 0.0);
  set_box_size(size_m, box);
  return box;
}

Model model_with(const std::vector<Thing>& things) {
  Model model = plane_model(things.size());
  for (std::size_t i = 0; i < things.size(); ++i) {
    scenario::Entity& entity = model.scenario.entities[i + 1];
    entity.kind = scenario::EntityKind::misc_object;
    entity.category = "obstacle";
    entity.mass_kg = things[i].mass_kg;
    entity.box = {{0.0, 0.0, 0.5 * things[i].size_m.z}, things[i].size_m.x, things[i].size_m.y, things[i].size_m.z};
  }
  return model;
}

/// The driver's car, at the origin, drives at a box.
CrashSite driven_at(const Thing& thing, double x_m, double speed_mps, double y_m = 0.0) {
  return {model_with({thing}), {}, speed_mps, {box_at(first_box, thing.size_m, x_m, y_m)}};
}

}  // namespace

TEST_CASE("a bin is knocked away by a car that hardly feels it, slides and rests, and one event tells of it") {
  CrashSite site = driven_at({}, 8.0, 12.0);
  const Vec2 before = site.momentum();
  for (int i = 0; site.state.bodies.bodies.empty() && i < 240; ++i) site.tick();
  REQUIRE(site.state.bodies.bodies.size() == 1);
  CHECK(glm::distance(site.momentum(), before) < 1e-9 * glm::length(before));
  REQUIRE(site.count("collision") == 1);
  CHECK(site.events.back().participant == first_box);
  CHECK(told(site.events.back(), "closing_speed_mps") == relative(12.0, 0.001));
  double fastest_mps = 0.0;
  for (int i = 0; i < 600; ++i) {
    site.tick();
    fastest_mps = std::max(fastest_mps, glm::length(site.participants[1].velocity_mps));
  }
  CHECK(site.state.car.velocity_mps.x > 11.5);  // It comes up with the sliding bin, and pushes it on.
  CHECK(fastest_mps > 12.0);
  CHECK(fastest_mps < 20.0);
  CHECK(is_box(site.participants[1]));
  CHECK(box_size_m(site.participants[1]).z == relative(1.1, 1e-9));
  CHECK_FALSE(site.participants[1].lamps.has(Lamp::brake));
}

TEST_CASE("a bin that was pushed comes to rest by its friction") {
  CrashSite site({});
  Participant bin = box_at(first_box, {0.6, 0.6, 1.1}, 0.0, 0.0);
  LooseBody loose = loose_body(bin, 15.0);
  loose.body.velocity_mps = {10.0, 0.0};
  site.model = model_with({{}});
  site.participants.push_back(bin);
  site.state.bodies.bodies.push_back(loose);
  for (int i = 0; i < 480 && !(site.rests() && i > 0); ++i) site.tick();
  CHECK(site.rests());
  // v²/2μg with the half of what a road holds a tyre.
  CHECK(site.participants[1].world_from_vehicle.position_m.x == relative(10.0 * 10.0 / (2.0 * 0.5 * 9.81), 0.1));
}

TEST_CASE("a container without a mass, and one that is too heavy, are met like a wall") {
  for (const double mass_kg : {0.0, 24'000.0}) {
    CAPTURE(mass_kg);
    CrashSite site = driven_at({{6.0, 2.44, 2.6}, mass_kg}, 12.0, 12.0);
    for (int i = 0; i < 240; ++i) site.tick();
    REQUIRE(site.count("collision") == 1);
    CHECK(site.state.car.velocity_mps.x < 0.0);
    CHECK(site.state.car.velocity_mps.x > -0.3 * 12.0);
    const Vec3 at_m = site.participants[1].world_from_vehicle.position_m;
    CHECK(glm::distance(at_m, Vec3(12.0, 0.0, 0.0)) < 1e-9);
    REQUIRE(site.count(crash_event) == 1);
    const auto told_of = std::ranges::find(site.events, std::string(crash_event), &Event::kind);
    const auto record = read_crash(*told_of->participant, told_of->detail);
    REQUIRE(record.has_value());
    CHECK_FALSE(record->of_second.mass_kg.has_value());
    CHECK(glm::length(record->of_first.delta_v_mps.value_or(Vec2(0.0))) > 12.0);
  }
}

TEST_CASE("a block of a tonne is pushed by as much as the masses say") {
  CrashSite site = driven_at({{2.0, 1.0, 0.9}, 1000.0}, 8.0, 12.0);
  const Vec2 before = site.momentum();
  for (int i = 0; i < 100; ++i) site.tick(false);
  REQUIRE(site.state.bodies.bodies.size() == 1);
  CHECK(glm::distance(site.momentum(), before) < 1e-9 * glm::length(before));
  const double car_kg = site.model.car.body.mass_kg;
  const double common_mps = 12.0 * car_kg / (car_kg + 1000.0);
  CHECK(site.state.bodies.bodies.front().body.velocity_mps.x > common_mps);
  CHECK(site.state.bodies.bodies.front().body.velocity_mps.x < 1.25 * common_mps);
}

TEST_CASE("a wreck runs into a crate, the crate into the next one, and each pair is told once") {
  Model model = model_with({{}, {{1.2, 1.2, 1.0}, 80.0}, {{1.2, 1.2, 1.0}, 80.0}});
  scenario::Entity& car = model.scenario.entities[1];
  car = {};
  car.model = *find_vehicle_model("saloon");
  CrashSite site(std::move(model), {{0.0, 1e4, 0.0}, {}}, 0.0,
                 {placed_participant(first_box, "saloon", 0.0, 0.0, 0.0, 14.0),
                  box_at(first_box + 1, {1.2, 1.2, 1.0}, 8.0, 0.1), box_at(first_box + 2, {1.2, 1.2, 1.0}, 10.0, 0.1)});
  for (int i = 0; i < 720; ++i) site.tick();
  CHECK(site.state.bodies.bodies.size() == 3);
  CHECK(site.count("crash_of_others") >= 2);
  CHECK(site.rests());
  const auto x_m = [&](std::size_t i) { return site.participants[i].world_from_vehicle.position_m.x; };
  CHECK(x_m(2) > 8.5);
  CHECK(x_m(3) > x_m(2) + 1.19);
}

TEST_CASE("a box hardly gives: what runs into it is not seen in it") {
  CrashSite site = driven_at({{1.2, 1.2, 1.0}, 60.0}, 8.0, 15.0);
  double deepest_m = 0.0;
  for (int i = 0; i < 240; ++i) {
    site.tick();
    for (const BodyContact& contact : site.state.bodies.contacts)
      deepest_m = std::max(deepest_m, impact::crushed_off_m(impact_side(site.participants[1], 60.0).outline,
                                                            contact.engagement.second, Vec2(-1.0, 0.0)));
  }
  REQUIRE(site.state.bodies.bodies.size() == 1);
  CHECK(deepest_m > 0.0);
  CHECK(deepest_m < 0.06);
}

TEST_CASE("a box longer than every vehicle is near whatever touches its end") {
  const std::vector<Participant> two{placed_participant(1, "saloon", 0.0, 0.0, 0.0, 0.0),
                                     box_at(first_box, {60.0, 0.4, 3.0}, 33.0, 0.0)};
  CHECK(near_pairs(two, first_traffic_participant, {}).size() == 1);
  CHECK(overlap(two[0], two[1]));
  const std::vector<Participant> other_way{two[1], placed_participant(9, "saloon", 66.0, 0.0, 0.0, 0.0)};
  CHECK(near_pairs(other_way, first_traffic_participant, {}).size() == 1);
}

TEST_CASE("a box above a car's roof is not met") {
  const Participant car = placed_participant(1, "saloon", 0.0, 0.0, 0.0, 0.0);
  Participant box = box_at(first_box, {2.0, 2.0, 0.5}, 0.0, 0.0);
  CHECK(overlap(car, box));
  box.world_from_vehicle.position_m.z = 2.0;
  CHECK_FALSE(overlap(car, box));
}

TEST_CASE("a box that its script moves and that has no mass stays on its script") {
  const Model model = model_with({{{6.0, 2.4, 2.6}, 0.0}, {}});
  Participant moving = box_at(first_box, {6.0, 2.4, 2.6}, 0.0, 0.0);
  CHECK(may_leave_rails(model, moving));
  moving.velocity_mps.x = 2.0;
  CHECK_FALSE(may_leave_rails(model, moving));
  Participant light = box_at(first_box + 1, {0.6, 0.6, 1.1}, 0.0, 0.0);
  light.velocity_mps.x = 2.0;
  CHECK(may_leave_rails(model, light));
}

#include "engine/simulation/solid_motion.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/scene/motion.hpp"
#include "engine/simulation/solids.hpp"
#include "engine/simulation/storyboard_stage.hpp"
#include "engine/world/solid.hpp"
#include "tests/engine/simulation/stood_solid.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::simulation {
namespace {

constexpr ParticipantId solid_number = first_solid_participant + 3;

/// A box of 2 × 1 × 1 m that stands there.
StandSolid standing_box(double x_m, double y_m) {
  return {.solid = 3, .x_m = x_m, .y_m = y_m, .length_m = 2.0, .width_m = 1.0, .height_m = 1.0};
}
StandSolid moving(StandSolid box, const Vec3& velocity_mps) {
  box.about_x_m = box.x_m, box.about_y_m = box.y_m;
  box.legs = {{.velocity_mps = velocity_mps}};
  return box;
}
StandSolid weighing(StandSolid box, double kg) {
  box.mass_kg = kg;
  return box;
}

const LooseBody& solid(const CrashSite& site) { return *find_loose(site.state, solid_number); }
bool shows_free(const CrashSite& site) { return is_free_solid(*find_participant(site.participants, solid_number)); }
const Event& first_event(const CrashSite& site, std::string_view kind) {
  return *std::ranges::find(site.events, kind, &Event::kind);
}

}  // namespace

TEST_CASE("a solid in motion is at each tick where its thing is drawn, with its velocity") {
  CrashSite site = alone(0.0);
  StandSolid box = standing_box(30.0, 40.0);
  box.about_x_m = 28.0, box.about_y_m = 41.0, box.heading_rad = 0.2;
  box.legs = {{0.1, {3.0, 1.0, 0.2}, {0.0, -2.0, 0.0}, {0.0, 0.0, 1.5}},
              {.from_s = 0.6, .velocity_mps = {0.0, 4.0, 0.0}}};
  stand_in(box, site);
  const scene::Motion drawn{{28.0, 41.0, 0.0}, {1.0, 0.0, 0.0, 0.0}, box.legs};
  Vec2 before_m = solid(site).body.mass_centre_m;
  for (int i = 0; i < 120; ++i) {
    site.tick();
    const scene::MovingPose pose = scene::pose_at(drawn, site.state.time_s());
    const Participant shown = participant_of(solid(site));
    CHECK(glm::distance(shown.world_from_vehicle.position_m, pose.world_from_object * Vec3(2.0, -1.0, 0.0)) < 1e-9);
    const Vec2 ahead(shown.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0));
    const Vec3 wanted = pose.world_from_object.orientation * Vec3(std::cos(0.2), std::sin(0.2), 0.0);
    CHECK(glm::distance(ahead, Vec2(wanted)) < 1e-9);
    const Vec2 way_mps = (solid(site).body.mass_centre_m - before_m) / tick_s;
    const bool at_bend = i < 13 || (i > 70 && i < 73);
    if (!at_bend) CHECK(glm::distance(solid(site).body.velocity_mps, way_mps) < 0.05);
    before_m = solid(site).body.mass_centre_m;
  }
  CHECK_FALSE(shows_free(site));
  CHECK(site.events.empty());
}

TEST_CASE("a solid that crosses the car's way is met where it is at that time, and nowhere else") {
  for (const double begins_m : {-15.0, -40.0}) {
    CAPTURE(begins_m);
    CrashSite site = alone(10.0);
    // The car's front is there 1.5 s after the beginning.
    stand_in(moving(standing_box(20.0, begins_m), {0.0, 10.0, 0.0}), site);
    pass(site, 3.0);
    CHECK(site.count("collision") == (begins_m == -15.0 ? 1 : 0));
    CHECK(is_led(site.state, solid_number));
    CHECK(site.state.diagnostics.bad_numbers == 0);
  }
}

TEST_CASE("a solid's own velocity is in the closing speed, and the car that stands is pushed away by it") {
  CrashSite site = alone(0.0);
  stand_in(moving(standing_box(15.0, 0.0), {-6.0, 0.0, 0.0}), site);
  pass(site, 3.0);
  REQUIRE(site.count("collision") == 1);
  CHECK(told(first_event(site, "collision"), "closing_speed_mps") == relative(6.0, 0.01));
  CHECK(first_event(site, "collision").detail.ends_with("by=other"));
  CHECK(site.car.participant.velocity_mps.x < -5.5);
  CHECK(solid(site).body.velocity_mps == Vec2(-6.0, 0.0));
}

TEST_CASE("what the car loses of its momentum a solid with a mass has") {
  CrashSite site = alone(12.0);
  stand_in(weighing(standing_box(8.0, 0.3), 400.0), site);
  CHECK(shows_free(site));
  const Vec2 before_ns = site.momentum();
  for (int i = 0; i < 120; ++i) site.tick(false);
  CHECK(site.count("collision") == 1);
  CHECK(solid(site).body.velocity_mps.x > 8.0);
  CHECK(solid(site).body.mass_kg == 400.0);
  CHECK(glm::distance(site.momentum(), before_ns) < 1e-6 * glm::length(before_ns));
}

TEST_CASE("the first push ends the motion of a solid with a mass: it slides, rests and is met there") {
  CrashSite site = alone(12.0);
  stand_in(weighing(moving(standing_box(20.0, -6.0), {0.0, 4.0, 0.0}), 60.0), site);
  pass(site, 0.5);
  CHECK(is_led(site.state, solid_number));
  CHECK_FALSE(shows_free(site));
  pass(site, 1.5);
  CHECK(site.count("collision") >= 1);
  CHECK_FALSE(is_led(site.state, solid_number));
  CHECK(shows_free(site));
  CHECK(solid(site).body.mass_centre_m.x > 21.0);
  pass(site, 8.0);
  CHECK(site.rests());
  CHECK(solid(site).body.mass_centre_m.y < 20.0);
}

TEST_CASE("a solid whose motion leaves the range of snapshots rests where it last was") {
  for (const double speed_mps : {200.0, 900.0}) {
    CrashSite site = alone(0.0);
    StandSolid box = moving(standing_box(farthest_solid_m - 1000.0, 50.0), {speed_mps, 0.0, 0.0});
    if (speed_mps > 500.0) box.x_m = box.about_x_m = 1000.0, box.legs.front().acceleration_mps2 = {200.0, 0.0, 0.0};
    stand_in(box, site);
    pass(site, 6.0);
    CHECK_FALSE(is_led(site.state, solid_number));
    CHECK(site.rests());
    CHECK(solid(site).body.mass_centre_m.x <= farthest_solid_m);
    CHECK_FALSE(shows_free(site));
  }
}

TEST_CASE("a solid that is stood again or cleared has nothing left of its motion") {
  CrashSite site = alone(0.0);
  stand_in(moving(standing_box(30.0, 0.0), {5.0, 0.0, 0.0}), site);
  pass(site, 0.5);
  stand_in(standing_box(40.0, 0.0), site);
  pass(site, 0.5);
  CHECK(solid(site).body.mass_centre_m == Vec2(40.0, 0.0));
  stand_in(moving(standing_box(30.0, 0.0), {5.0, 0.0, 0.0}), site);
  REQUIRE(clear_solid({3}, site.state).has_value());
  CHECK(site.state.solid_motions.empty());
  site.participants.resize(1);
  pass(site, 0.1);
}

TEST_CASE("traffic is told of a solid in motion as of an obstacle with its velocity") {
  CrashSite site = alone(0.0);
  stand_in(moving(standing_box(30.0, 0.0), {0.0, 5.0, 0.0}), site);
  site.tick();
  const auto foreign = foreign_vehicles(site.model, site.state, site.car.participant);
  REQUIRE(foreign.size() == 2);
  CHECK(foreign[1].adrift);
  CHECK(foreign[1].velocity_mps == Vec3(0.0, 5.0, 0.0));
  CHECK(foreign[1].world_from_vehicle.position_m.y == doctest::Approx(5.0 * tick_s));
}

}  // namespace septet::simulation

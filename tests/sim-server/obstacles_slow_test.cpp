#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/debris/piece.hpp"
#include "engine/simulation/server_step.hpp"
#include "sim-server/drive/traffic_choice.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {
namespace {

struct Outing {
  simulation::State state;
  std::vector<simulation::Event> events;
  Snapshot last;

  std::vector<std::string> hit() const {
    std::vector<std::string> what;
    for (const simulation::Event& event : events)
      if (event.kind == "collision" && !event.participant) what.push_back(event.detail);
    return what;
  }
};

const simulation::Model& model() {
  static const LoadedDrive drive = [] {
    LoadedDrive loaded = shipped_drive("behind-ambulance", "desktop");
    auto alone = std::make_shared<simulation::Model>(*loaded.model);
    loaded.model = alone;
    return loaded;
  }();
  return *drive.model;
}

/// The driver's car, alone on the motorway, let loose at a place of the world.
Outing let_loose(const Vec3& origin_m, double heading_rad, double speed_mps, double time_s, double accelerator = 0.0) {
  auto state = simulation::initial_state(model(), traffic::own_traffic(model().roads, 1));
  REQUIRE(state.has_value());
  Outing outing{std::move(*state), {}, {}};
  outing.state.traffic->stop();
  outing.state.car =
      vehicle::standstill(model().car, {origin_m, orientation_from_angles(heading_rad, 0.0, 0.0)}, speed_mps);
  outing.state.car_road.reset();
  DriverInput input;
  input.accelerator = accelerator;
  for (int tick = 0; tick < static_cast<int>(time_s * simulation::tick_rate_hz); ++tick)
    outing.last = simulation::server_step(model(), input, outing.state, outing.events);
  CHECK(outing.state.diagnostics.bad_numbers == 0);
  return outing;
}

/// Towards the middle of an obstacle, its front `gap_m` before it. `across_rad`: from square on.
Outing run_into(const Obstacle& obstacle, double side, double across_rad, double speed_mps, double time_s) {
  const Vec2 middle = 0.5 * (obstacle.from_m + obstacle.to_m), along = obstacle.to_m - obstacle.from_m;
  const double square_on = along == Vec2(0.0) ? 0.3 : std::atan2(along.y, along.x) - side * 1.5707963;
  const double heading = square_on + across_rad;
  const Vec2 ahead(std::cos(heading), std::sin(heading));
  const Vec2 origin = middle - 7.0 * ahead;
  const auto ground = road::surface_at(model().roads, origin, nullptr, 400.0);
  return let_loose(Vec3(origin, ground ? ground->height_m : 0.0), heading, speed_mps, time_s);
}

}  // namespace

TEST_CASE("the car hits each kind of thing beside the road and the log says what it hit") {
  const auto listed = model().obstacles->listed();
  for (int k = 0; k <= static_cast<int>(ObstacleKind::house); ++k) {
    const auto kind = static_cast<ObstacleKind>(k);
    // Rails and walls stand before these: hull_test drives into yielding ones.
    if (kind == ObstacleKind::portal || kind == ObstacleKind::marker_post) continue;
    // Where the road file has a road: beyond its ends the scenery goes on alone.
    const auto found = std::ranges::find_if(listed, [&](const Obstacle& o) {
      return o.kind == kind &&
             road::locate(model().roads, o.from_m, nullptr, kind == ObstacleKind::house ? 300.0 : 40.0).has_value();
    });
    REQUIRE(found != listed.end());
    const Obstacle& obstacle = *found;
    const bool yields = obstacle.yielding_kg > 0.0;
    for (const double speed : {8.0, 60.0}) {
      CAPTURE(name_of(kind));
      CAPTURE(speed);
      const Outing outing = run_into(obstacle, 1.0, 0.15, speed, 7.0 / speed + 0.4);
      const auto hit = outing.hit();
      REQUIRE(!hit.empty());
      CHECK(std::ranges::any_of(hit, [&](const std::string& what) { return what.starts_with(name_of(kind)); }));
      CHECK(hit.front().find("closing_speed_mps=") != std::string::npos);
      CHECK(hit.front().find("delta_v_mps=") != std::string::npos);
      CHECK(outing.state.diagnostics.collisions == hit.size());
      if (!yields) CHECK(glm::length(outing.state.car.velocity_mps) < 0.7 * speed);
      if (!yields && speed > 20.0)
        CHECK(outing.state.effects.debris.pieces.size() + outing.state.effects.debris.shards.size() > 0);
    }
  }
}

TEST_CASE("a car that grazes the rail at motorway speed goes on along it") {
  for (const double s : {700.0, 2500.0}) {
    const auto place = road::world_from_road(road::evaluate(model().roads, {0, s, -22.4}));
    const Vec3 ahead = place.orientation * Vec3(1.0, 0.0, 0.0);
    const Outing outing = let_loose(place.position_m, std::atan2(ahead.y, ahead.x) - 0.04, 30.0, 2.5);
    CHECK(outing.hit().size() == 1);
    CAPTURE(outing.hit().front());
    CHECK(outing.hit().front().starts_with("guard rail"));
    CHECK(glm::length(outing.state.car.velocity_mps) > 24.0);
    CHECK(outing.state.car_road->t_m > -23.85);
    CHECK(outing.state.effects.debris.pieces.empty());
  }
}

TEST_CASE("nobody drives through a wood however fast and at whatever angle") {
  const auto is_wood = [](const Vec2& place_m) {
    const auto near = model().obstacles->near(place_m, 6.0);
    return std::ranges::count_if(near, [](const Obstacle& o) { return o.kind == ObstacleKind::tree; }) >= 5;
  };
  struct Entry {
    double speed_mps, across_rad;  // From square on.
  };
  for (const Entry entry : {Entry{8.0, -0.6}, Entry{20.0, 0.0}, Entry{40.0, 0.4}}) {
    INFO("at ", entry.speed_mps, " m/s, ", entry.across_rad, " rad");
    int woods = 0;
    for (double s = 300.0; s < 9000.0 && woods < 1; s += 100.0)
      for (const double side : {-1.0, 1.0}) {
        // From the edge of a wood that is sixty metres deep that way: at full throttle for twenty seconds.
        const Vec2 edge = road::evaluate(model().roads, {0, s, side * 60.0}).position_m,
                   deep = road::evaluate(model().roads, {0, s, side * 160.0}).position_m;
        const double heading = std::atan2(deep.y - edge.y, deep.x - edge.x) + entry.across_rad;
        const Vec2 into(std::cos(heading), std::sin(heading));
        if (woods == 1 || !std::ranges::all_of(std::array{40.0, 60.0, 80.0, 100.0},
                                               [&](double way_m) { return is_wood(edge + way_m * into); }))
          continue;
        ++woods;
        const double height = road::world_from_road(road::evaluate(model().roads, {0, s, side * 60.0})).position_m.z;
        const Outing outing = let_loose(Vec3(edge, height), heading, entry.speed_mps, 20.0, 1.0);
        CHECK(glm::dot(Vec2(outing.state.car.world_from_body.position_m) - edge, into) < 80.0);
        REQUIRE(!outing.hit().empty());
        CHECK(outing.hit().front().starts_with("tree"));
      }
    CHECK(woods == 1);
  }
}

TEST_CASE("what was hit and how hard is in the state's hash") {
  const auto place = road::world_from_road(road::evaluate(model().roads, {0, 700.0, -22.4}));
  const Vec3 ahead = place.orientation * Vec3(1.0, 0.0, 0.0);
  const auto run = [&] { return let_loose(place.position_m, std::atan2(ahead.y, ahead.x) - 0.1, 30.0, 1.0); };
  Outing first = run();
  const Outing again = run();
  const std::uint64_t hash = hash_state(first.state);
  CHECK(hash == hash_state(again.state));
  first.state.hull.crush_m[8] += 0.01;
  CHECK(hash_state(first.state) != hash);
}

}  // namespace septet::server

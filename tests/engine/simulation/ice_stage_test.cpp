#include "engine/simulation/effects/ice_stage.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/simulation/wheel_ground.hpp"
#include "tests/engine/road/road_files.hpp"

using namespace septet;
using namespace septet::simulation;
using road::motorway;

namespace {

scenario::EffectAction slab(double x_m, double y_m) {
  scenario::EffectAction action;
  action.entity = 0;
  action.part = "ice-slab";
  action.x_m = x_m;
  action.y_m = y_m;
  return action;
}

/// A lorry off which these slabs will slide.
scenario::Scenario lorry_with(std::initializer_list<scenario::EffectAction> slabs) {
  scenario::Scenario scenario;
  scenario.entities.emplace_back().box = {{1.7, 0.0, 1.925}, 11.9, 2.55, 3.85};
  scenario::Event event;
  for (const scenario::EffectAction& action : slabs) event.actions.push_back({"", 0, action});
  scenario.stories.emplace_back().acts.emplace_back().groups.emplace_back().maneuvers.emplace_back().events = {event};
  return scenario;
}

/// A lorry on a morning with this much frost on the windscreen.
scenario::Scenario frosty(double share) {
  scenario::Scenario scenario = lorry_with({});
  scenario.init.push_back({.what = scenario::EnvironmentAction{.frost = share}});
  return scenario;
}

IceState start(const scenario::Scenario& scenario, double temperature_k) {
  scenario::ScenarioState storyboard;
  storyboard.environment.temperature_k = temperature_k;
  return initial_ice(motorway(), scenario, storyboard, scenario::no_entity, 1, 2, 1);
}

scenario::EffectAction black_ice(std::string road, int lane) {
  scenario::EffectAction action;
  action.kind = scenario::EffectAction::Kind::freeze;
  action.road = std::move(road);
  action.lane = lane;
  action.s_m = 1180.0;
  action.length_m = 40.0;
  action.thickness_m = 0.004;
  return action;
}

double friction_at(const IceState& ice, double s_m, int lane, double temperature_k) {
  const Vec3 at = road::evaluate_lane(motorway(), {0, lane, s_m, 0.0}).road.position_m;
  RoadWeather weather{.temperature_k = temperature_k};
  weather.black_ice = ice.black;
  weather.thawed_kh = ice.still.thawed_kh;
  road::RoadPosition place;
  vehicle::WheelGround wheel;
  REQUIRE(find_wheel_ground(motorway(), nullptr, weather, at + Vec3(0, 0, 0.3), false, place, wheel).has_value());
  return wheel.friction;
}

}  // namespace

TEST_CASE("slabs that the storyboard will spill lie on the roof until then, where they find room") {
  IceState state = start(lorry_with({slab(-2.6, -0.2), slab(-2.2, 0.3), slab(-0.4, 0.4), slab(0.5, 1.7)}), 280.0);
  REQUIRE(state.still.slabs.size() == 2);  // One would lie in another, one over the edge.
  CHECK(state.still.slabs[0].vehicle == 2);
  CHECK(glm::length(state.still.slabs[1].foot_m - Vec3(-0.4, 0.4, 3.87)) < 1e-9);
  CHECK(release_slab(2, {-2.6, -0.2}, 0.08, state) == 1.0);
  REQUIRE(state.still.slabs.size() == 1);
  CHECK(state.still.slabs[0].foot_m.x == -0.4);
  state.still.thawed_kh = 120.0;  // Half of its 80 mm.
  CHECK(release_slab(2, {-0.4, 0.4}, 0.08, state) == doctest::Approx(0.5));
  CHECK(state.still.slabs.empty());
}

TEST_CASE("in frost icicles hang at the mouths of the tunnel and along the bridge and else nowhere") {
  CHECK(start(lorry_with({}), 280.0).still.rows.empty());
  const IceState state = start(lorry_with({}), 268.0);
  REQUIRE(state.still.rows.size() > 20);
  const road::Road& road = motorway().roads[0];
  std::size_t at_tunnel = 0, at_bridge = 0;
  for (const ice::IcicleRow& row : state.still.rows) {
    for (const Vec3& end : {row.from_m, row.to_m}) {
      const auto place = road::locate(motorway(), end, nullptr, 30.0);
      REQUIRE(place);
      for (const road::RoadStructure& structure : road.structures) {
        const double s = place->position.s_m - structure.s_m;
        if (structure.kind == road::RoadStructure::Kind::bridge && s > -1.0 && s < structure.length_m + 1.0)
          ++at_bridge;
        if (structure.kind == road::RoadStructure::Kind::tunnel &&
            std::min(std::abs(s), std::abs(s - structure.length_m)) < 0.4)
          ++at_tunnel;
      }
    }
    CHECK(glm::length(row.to_m - row.from_m) < 7.0);
  }
  CHECK(at_tunnel > 8);
  CHECK(at_bridge + at_tunnel == 2 * state.still.rows.size());
}

TEST_CASE("black ice takes the wheels' grip where it lies and until it has thawed") {
  IceState state;
  freeze(motorway(), black_ice("1", -7), state);
  REQUIRE(state.black.size() == 1);
  REQUIRE(state.still.sheets.size() == 1);
  const double dry = friction_at(state, 1100.0, -7, 268.15), iced = friction_at(state, 1200.0, -7, 268.15);
  CHECK(iced == doctest::Approx(vehicle::peak_friction(vehicle::SurfaceKind::ice, 268.15)));
  CHECK(iced < 0.5 * dry);
  CHECK(friction_at(state, 1200.0, -6, 268.15) == dry);
  CHECK(friction_at(state, 1179.0, -7, 268.15) == dry);
  CHECK(friction_at(state, 1221.0, -7, 268.15) == dry);
  // Four millimetres are twelve degree-hours: two hours at six degrees.
  for (int i = 0; i < 7000; ++i) advance_ice({ice::freezing_k + 6.0, 0.0}, 1.0, 2, state);
  CHECK(friction_at(state, 1200.0, -7, 268.15) == iced);
  for (int i = 0; i < 300; ++i) advance_ice({ice::freezing_k + 6.0, 0.0}, 1.0, 2, state);
  CHECK(friction_at(state, 1200.0, -7, 268.15) == dry);
  // Later ice is there in full.
  freeze(motorway(), black_ice("1", -7), state);
  CHECK(friction_at(state, 1200.0, -7, 268.15) == iced);
}

TEST_CASE("black ice lies within its lane on the road, and nowhere where there is none") {
  IceState state;
  freeze(motorway(), black_ice("no such road", -7), state);
  freeze(motorway(), black_ice("1", -70), state);
  CHECK(state.black.empty());
  freeze(motorway(), black_ice("1", -7), state);
  const ice::Sheet& sheet = state.still.sheets.at(0);
  REQUIRE(sheet.left_m.size() == 41);
  for (std::size_t i = 0; i < sheet.left_m.size(); ++i)
    for (const Vec3& edge : {sheet.left_m[i], sheet.right_m[i]}) {
      const auto ground = road::surface_at(motorway(), edge, nullptr, 5.0);
      REQUIRE(ground);
      CHECK(std::abs(ground->height_m - edge.z) < 1e-6);
      const auto lane = road::lanes_at(motorway().roads[0], ground->position.s_m, ground->position.t_m);
      CHECK(lane.lane == -7);
    }
}

TEST_CASE("the keyframe of still ice is renewed when there is another to tell and not before") {
  IceState state = start(lorry_with({slab(-2.6, -0.2)}), 280.0);
  REQUIRE(ice::decode(state.keyframe.data));
  CHECK(ice::decode(state.keyframe.data)->slabs.size() == 1);
  advance_ice({270.0, 20.0}, 0.1, 4, state);
  CHECK(state.keyframe.tick == 0);
  advance_ice({290.0, 20.0}, 60.0, 6, state);
  CHECK(state.keyframe.tick == 6);
  release_slab(2, {-2.6, -0.2}, 0.08, state);
  advance_ice({270.0, 20.0}, 0.1, 8, state);
  CHECK(state.keyframe.tick == 8);
  REQUIRE(ice::decode(state.keyframe.data));
  CHECK(ice::decode(state.keyframe.data)->slabs.empty());
}

TEST_CASE(
    "a windscreen has no frost unless the scenario asks for it, and then as much as it asks for, from the first "
    "instant") {
  CHECK(start(lorry_with({}), 268.15).panes.empty());
  CHECK(start(lorry_with({}), 233.15).glass_keyframe.data.empty());
  CHECK(start(frosty(0.0), 268.15).panes.empty());
  CHECK(start(frosty(1.0), ice::freezing_k).panes.empty());
  CHECK(start(frosty(1.0), 290.0).glass_keyframe.data.empty());
  for (const double share : {0.01, 0.25, 0.5, 0.9, 1.0}) {
    const IceState state = start(frosty(share), 268.15);
    REQUIRE(state.panes.size() == 1);
    CHECK(state.panes[0].frost.thickness_kgpm2 == doctest::Approx(0.15 * share));
    CHECK(state.glass_keyframe.tick == 0);
    const auto told = ice::decode_glass(state.glass_keyframe.data);
    REQUIRE(told);
    REQUIRE(told->size() == 1);
    CHECK(std::abs((*told)[0].frost.thickness_kgpm2 - 0.15 * share) < 0.00051);  // Encoded in g/m².
  }
  // Init may set the environment more than once: the last one counts, and one without frost leaves it.
  scenario::Scenario twice = frosty(1.0);
  twice.init.push_back({.what = scenario::EnvironmentAction{.snow_cover = 1.0}});
  CHECK(start(twice, 268.15).panes.size() == 1);
  twice.init.push_back({.what = scenario::EnvironmentAction{.frost = 0.0}});
  CHECK(start(twice, 268.15).panes.empty());
}

TEST_CASE("a windscreen has frost in the morning and stars where blows shook it, but for those at walking pace") {
  IceState state = start(frosty(1.0), 268.15);
  REQUIRE(state.panes.size() == 1);
  CHECK(state.panes[0].vehicle == 1);
  CHECK(state.panes[0].frost.thickness_kgpm2 == doctest::Approx(0.15));
  CHECK(start(lorry_with({}), 280.0).panes.empty());
  shake_glass({7, false, 0.5, 1.0}, state);
  CHECK(state.panes.size() == 1);
  shake_glass({1, false, 0.2, 10.0}, state);
  for (int i = 0; i < 20; ++i) shake_glass({7, false, 0.8, 25.0 + i}, state);
  REQUIRE(state.panes.size() == 2);
  for (const ice::Pane& pane : state.panes) {
    const bool drivers = pane.vehicle == 1;
    REQUIRE(pane.stars.size() == (drivers ? 1 : ice::most_stars));
    CHECK(std::abs(pane.stars[0].across - (drivers ? 0.2 : 0.8)) <= 0.1);
    CHECK(pane.stars[0].reach_m == doctest::Approx(drivers ? 0.35 : 0.875));
  }
  advance_ice({268.15, 0.0}, 0.1, 2, state);
  CHECK(state.glass_keyframe.id == ice::glass_effect_id);
  const auto read = ice::decode_glass(state.glass_keyframe.data);
  REQUIRE(read);
  REQUIRE(read->size() == 2);
  CHECK((*read)[0].stars[0].seed == state.panes[0].stars[0].seed);
  // One that has flown out of its car has neither frost nor cracks, and the screens are notified.
  shake_glass({1, true, 0.2, 30.0}, state);
  shake_glass({9, true, 0.2, 30.0}, state);
  REQUIRE(state.panes.size() == 1);
  CHECK(state.panes[0].vehicle == 7);
  advance_ice({268.15, 0.0}, 0.1, 4, state);
  CHECK(state.glass_keyframe.tick == 4);
  REQUIRE(ice::decode_glass(state.glass_keyframe.data));
  CHECK(ice::decode_glass(state.glass_keyframe.data)->size() == 1);
}

TEST_CASE("the blower thaws the driver's windscreen until nothing of it is left to tell") {
  IceState state = start(frosty(1.0), 268.15);
  double before = state.panes[0].frost.melted_kgpm2.back();
  for (int i = 0; i < 120; ++i) advance_ice({268.15, 20.0}, 0.5, 2, state);
  REQUIRE(state.panes.size() == 1);
  CHECK(state.panes[0].frost.melted_kgpm2.back() > before);
  for (int i = 0; i < 2000; ++i) advance_ice({278.15, 20.0}, 0.5, 4, state);
  CHECK(state.panes.empty());
  REQUIRE(ice::decode_glass(state.glass_keyframe.data));
  CHECK(ice::decode_glass(state.glass_keyframe.data)->empty());
}

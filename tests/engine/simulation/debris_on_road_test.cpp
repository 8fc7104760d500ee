// Debris, the road under it and the vehicles around it.

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/debris/piece.hpp"
#include "engine/effects/ice/still_ice.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "engine/simulation/effects/effect_surroundings.hpp"
#include "engine/simulation/effects/effects_stage.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::simulation;
using road::motorway;

namespace {

RigidTransform on_lane(double s_m, int lane) {
  return road::world_from_lane(road::evaluate_lane(motorway(), {0, lane, s_m, 0.0}));
}

Participant vehicle_on_lane(ParticipantId id, std::string_view model, double s_m, int lane) {
  Participant p;
  p.id = id;
  p.model = *find_vehicle_model(model);
  p.world_from_vehicle = on_lane(s_m, lane);
  return p;
}

void put(debris::Part part, const RigidTransform& place, EffectsState& state, bool asleep = false) {
  Random random(1);
  debris::spawn_part(state.debris, part, place, Vec3(0.0), Vec3(0.0), random);
  state.debris.pieces.back().asleep = asleep;
}

RigidTransform over_lane(double s_m, double up_m) {
  RigidTransform place = on_lane(s_m, -5);
  place.position_m += place.orientation * Vec3(0.0, 0.0, up_m);
  return place;
}

EffectsReport step(const std::vector<Participant>& participants, EffectsState& state) {
  static const Environment environment;
  return advance_effects({motorway(), nullptr, participants, environment, 1, 1.0, 2, 1.0 / 120.0}, state);
}

}  // namespace

TEST_CASE("the ground below debris is the road's surface to a centimetre and as slippery as it is") {
  EffectsState state;
  for (const double s_m : {900.0, 2500.0, 4100.0})
    for (double along = 0.0; along < 3.0; along += 0.37) {
      const Vec3 at = on_lane(s_m + along, -3).position_m;
      const debris::GroundPoint point = surface_below(motorway(), 0.4, at.x, at.y, state);
      CHECK(std::abs(point.height_m - at.z) < 0.01);
      CHECK(point.friction_factor == 0.4);
      CHECK(point.normal.z > 0.9);
    }
  // A cell's plane rises with its slope.
  const Vec3 start = on_lane(900.0, -3).position_m;
  const double x = std::floor(start.x), y = std::floor(start.y);
  const auto height = [&](double dx, double dy) {
    return surface_below(motorway(), 1.0, x + dx, y + dy, state).height_m;
  };
  const Vec3 normal = surface_below(motorway(), 1.0, start.x, start.y, state).normal;
  CHECK(height(0.9, 0.5) - height(0.1, 0.5) == doctest::Approx(-0.8 * normal.x / normal.z));
  CHECK(height(0.5, 0.9) - height(0.5, 0.1) == doctest::Approx(-0.8 * normal.y / normal.z));
  CHECK(std::abs(normal.x) + std::abs(normal.y) > 0.005);
  CHECK(surface_below(motorway(), 1.0, 1e8, 0.0, state).height_m < -1e8);
}

TEST_CASE("a wheel climbs debris up to ten centimetres and none that is in the air") {
  const Vec3 ground = on_lane(900.0, -5).position_m;
  EffectsState low, high, flying;
  put(debris::Part::ice_slab, over_lane(900.0, 0.02), low);
  put(debris::Part::barrier_post, over_lane(900.0, 0.0), high);
  put(debris::Part::ice_slab, over_lane(900.0, 1.5), flying);
  CHECK(obstacle_height_m(low, ground) == relative(0.06, 0.05));
  CHECK(obstacle_height_m(high, ground) == 0.1);
  CHECK(obstacle_height_m(flying, ground) == 0.0);
  CHECK(obstacle_height_m({}, ground) == 0.0);
}

TEST_CASE("what lies far from the driver is gone and of too much the farthest") {
  const std::vector<Participant> driver{vehicle_on_lane(1, "volvo-s80", 900.0, -5)};
  EffectsState far;
  put(debris::Part::lamp, over_lane(900.0 + 0.9 * debris_reach_m, 0.1), far, true);
  put(debris::Part::lamp, over_lane(900.0 + 1.1 * debris_reach_m, 0.1), far, true);
  step(driver, far);
  REQUIRE(far.debris.pieces.size() == 1);
  CHECK(far.debris.pieces.front().id == 1);
  EffectsState many;
  for (std::size_t i = 0; i < most_pieces + 3; ++i)
    put(debris::Part::lamp, over_lane(910.0 + 0.5 * static_cast<double>(i), 0.1), many, true);
  step(driver, many);
  REQUIRE(many.debris.pieces.size() == most_pieces);
  CHECK(many.debris.pieces.back().id == most_pieces);
}

TEST_CASE("a car without its lamps in front has no beam and one without those behind brakes unseen") {
  std::vector<Participant> both{vehicle_on_lane(1, "saloon", 900.0, -5), vehicle_on_lane(2, "saloon", 950.0, -5)};
  for (Participant& p : both)
    for (const Lamp lamp : {Lamp::low_beam, Lamp::high_beam, Lamp::brake, Lamp::reverse}) p.lamps.set(lamp, true);
  EffectsState state;
  const auto all = debris::passenger_car_parts(body_box(both[0]).half_size_m);
  for (const debris::MountedPart& mounted : all) {
    if (mounted.part != debris::Part::lamp || mounted.box_from_part.position_m.x < 0.0)
      state.crashes.parts[1].push_back(mounted);
    if (mounted.part != debris::Part::lamp || mounted.box_from_part.position_m.x > 0.0)
      state.crashes.parts[2].push_back(mounted);
  }
  show_damage(state, both);
  CHECK_FALSE(both[0].lamps.has(Lamp::low_beam));
  CHECK_FALSE(both[0].lamps.has(Lamp::high_beam));
  CHECK(both[0].lamps.has(Lamp::brake));
  CHECK(both[1].lamps.has(Lamp::low_beam));
  CHECK_FALSE(both[1].lamps.has(Lamp::brake));
  CHECK_FALSE(both[1].lamps.has(Lamp::reverse));
}

TEST_CASE("what slides off a roof leaves it backwards") {
  EffectsState state;
  scenario::Entity lorry;
  lorry.box = {{1.7, 0.0, 1.925}, 11.9, 2.55, 3.85};
  scenario::EntityState from;
  from.active = true;
  from.world_from_entity = on_lane(850.0, -5);
  const Vec3 forward = from.world_from_entity.orientation * Vec3(1.0, 0.0, 0.0);
  from.velocity_mps = 22.0 * forward;
  scenario::EffectAction action;
  action.part = "ice-slab";
  action.slide_mps = 3.0;
  spill(action, lorry, from, 2, state);
  REQUIRE(state.debris.pieces.size() == 1);
  const auto& slab = state.debris.pieces.front().body;
  const Vec3 mps = debris::from_eigen(elastic::momentum_ns(slab)) / elastic::total_mass_kg(slab);
  CHECK(glm::dot(mps, forward) == doctest::Approx(19.0));
  CHECK(elastic::centre_of_mass_m(slab).z() - from.world_from_entity.position_m.z ==
        relative(3.85 + 0.04 + 0.02, 0.01));
}

TEST_CASE("the driver's car feels what it drives into and vehicles far from debris are not looked at") {
  EffectsState state;
  put(debris::Part::traffic_cone, over_lane(900.0, 0.252), state, true);
  std::vector<Participant> participants{vehicle_on_lane(1, "volvo-s80", 896.2, -5),
                                        vehicle_on_lane(2, "saloon", 990.0, -5)};
  const Vec3 forward = participants[0].world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  participants[0].velocity_mps = 22.0 * forward;
  int driver_box = 7;
  static const Environment environment;
  CHECK(
      vehicle_boxes({motorway(), nullptr, participants, environment, 1, 1.0, 2, 1.0 / 120.0}, state.debris, driver_box)
          .size() == 1);
  CHECK(driver_box == 0);
  CHECK(
      vehicle_boxes({motorway(), nullptr, participants, environment, 2, 1.0, 2, 1.0 / 120.0}, state.debris, driver_box)
          .size() == 1);
  CHECK(driver_box == -1);
  double felt_ns = 0.0;
  for (int k = 0; k < 4; ++k) {
    felt_ns += glm::dot(step(participants, state).impulse_on_driver_ns, forward);
    participants[0].world_from_vehicle.position_m += participants[0].velocity_mps / 60.0;
  }
  CHECK(felt_ns < -5.0);
  CHECK(felt_ns > -2.0 * debris::part_recipe(debris::Part::traffic_cone).mass_kg * 22.0 * 1.5);
}

TEST_CASE("what stands beside the road is looked for around what moves") {
  debris::State debris;
  Random random(1);
  for (int i = 0; i < 3; ++i)
    debris::spawn_part(debris, debris::Part::lamp, {{1.0 * i, 0, 1}, {1, 0, 0, 0}}, Vec3(0.0), Vec3(0.0), random);
  debris.pieces[1].asleep = true;
  debris.shards.resize(20);
  for (std::size_t i = 0; i < 17; ++i) debris.shards[i].velocity_mps = {1.0, 0.0, 0.0};
  CHECK(moving_places(debris).size() == 2 + 3);  // Of 17 shards the first, the ninth and the seventeenth.
}

TEST_CASE("ice on the road melts by the law of the ice on roofs and keeps in frost") {
  const std::vector<Participant> driver{vehicle_on_lane(1, "volvo-s80", 900.0, -5)};
  const double whole_kg = debris::part_recipe(debris::Part::ice_slab).mass_kg, whole_m = 0.08;
  // A second of 36,000 K has the heat of an hour at 10 K.
  const auto mass_after_a_second_kg = [&](double temperature_k) {
    EffectsState state;
    put(debris::Part::ice_slab, over_lane(920.0, 0.05), state, true);
    Environment environment;
    environment.temperature_k = temperature_k;
    for (Tick tick = 2; tick <= 120; tick += effects_step_ticks)
      advance_effects({motorway(), nullptr, driver, environment, 1, 1.0, tick, 1.0 / 120.0}, state);
    double mass_kg = 0.0;
    for (const debris::Piece& piece : state.debris.pieces) mass_kg += elastic::total_mass_kg(piece.body);
    return mass_kg;
  };
  CHECK(mass_after_a_second_kg(272.15) == relative(whole_kg, 1e-3));
  const double left = ice::left_m(whole_m, ice::degree_hours(36'273.15, 1.0)) / whole_m;
  CHECK(whole_kg - mass_after_a_second_kg(36'273.15) == relative(whole_kg * (1.0 - left), 0.01));
}

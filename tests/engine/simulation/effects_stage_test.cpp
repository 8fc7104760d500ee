#include "engine/simulation/effects/effects_stage.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/debris/contacts.hpp"
#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "engine/simulation/effects/effect_surroundings.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/engine/simulation/placed_participant.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::simulation;
using road::motorway;

namespace {

constexpr double step_s = 1.0 / 120.0;

RigidTransform on_motorway(double s_m, int lane) {
  return road::world_from_lane(road::evaluate_lane(motorway(), {0, lane, s_m, 0.0}));
}

Participant vehicle_on_lane(ParticipantId id, std::string_view model, double s_m, int lane, double speed_mps) {
  Participant p;
  p.id = id;
  p.model = *find_vehicle_model(model);
  p.world_from_vehicle = on_motorway(s_m, lane);
  p.velocity_mps = p.world_from_vehicle.orientation * Vec3(speed_mps, 0.0, 0.0);
  return p;
}

/// Drives everybody straight on and steps the effects for some ticks.
EffectsReport run(std::vector<Participant>& participants, EffectsState& state, Tick from, Tick ticks) {
  EffectsReport last;
  static const Environment environment;
  for (Tick tick = from; tick < from + ticks; tick += effects_step_ticks) {
    last = advance_effects({motorway(), nullptr, participants, environment, 1, 1.0, tick, step_s}, state);
    for (Participant& p : participants)
      p.world_from_vehicle.position_m += p.velocity_mps * (step_s * static_cast<double>(effects_step_ticks));
  }
  return last;
}

EffectsState slab_from_a_lorry(std::uint64_t seed) {
  EffectsState state;
  state.random = Random(seed, 2);
  scenario::Entity lorry;
  lorry.box = {{1.7, 0.0, 1.925}, 11.9, 2.55, 3.85};
  scenario::EntityState where;
  where.active = true;
  where.world_from_entity = on_motorway(850.0, -5);
  where.velocity_mps = where.world_from_entity.orientation * Vec3(22.0, 0.0, 0.0);
  scenario::EffectAction action;
  action.part = "ice-slab";
  action.x_m = -2.6;
  action.slide_mps = 3.0;
  spill(action, lorry, where, 2, state);
  return state;
}

/// A part at rest, its middle so high over the lane at 900 m.
void put_on_lane(debris::Part part, double up_m, EffectsState& state) {
  RigidTransform place = on_motorway(900.0, -5);
  place.position_m += place.orientation * Vec3(0.0, 0.0, up_m);
  Random random(1);
  debris::spawn_part(state.debris, part, place, Vec3(0.0), Vec3(0.0), random);
}

double mass_kg(const std::vector<debris::MountedPart>& parts) {
  double mass = 0.0;
  for (const debris::MountedPart& mounted : parts) mass += debris::part_recipe(mounted.part).mass_kg;
  return mass;
}

std::vector<Participant> lorry_and_driver() {
  return {vehicle_on_lane(1, "volvo-s80", 810.0, -5, 22.0), vehicle_on_lane(2, "lorry", 850.0, -5, 22.0)};
}

}  // namespace

TEST_CASE("the air over a bonnet is free while a lorry is a box up to its front") {
  const auto gap = [](const char* model, double behind_front_m, double height_share) {
    Participant shown;
    shown.model = *find_vehicle_model(model);
    const VehicleModel& shape = vehicle_models()[shown.model];
    return debris::gap_to_box(body_box(shown), {shape.front_m() - behind_front_m, 0.0, height_share * shape.height_m})
        .gap_m;
  };
  CHECK(gap("saloon", 0.3, 0.9) > 0.2);
  CHECK(gap("saloon", 0.3, 0.5) < 0.0);
  CHECK(gap("saloon", 2.5, 0.95) < 0.0);
  CHECK(gap("van", 0.3, 0.9) > 0.4);
  CHECK(gap("lorry", 0.3, 0.9) < 0.0);
}

TEST_CASE("a slab of ice slides off a lorry and breaks on the road and lies there") {
  EffectsState state = slab_from_a_lorry(3);
  REQUIRE(state.debris.pieces.size() == 1);
  auto participants = lorry_and_driver();
  participants.erase(participants.begin());
  run(participants, state, 2, 360);
  CHECK(state.debris.pieces.size() > 1);
  for (const debris::Piece& piece : state.debris.pieces) {
    const Vec3 at = debris::from_eigen(piece.body.position_m.front());
    const auto ground = road::surface_at(motorway(), {at.x, at.y}, nullptr, 60.0);
    REQUIRE(ground);
    CHECK(at.z > ground->height_m - 0.05);
    CHECK(at.z < ground->height_m + 1.5);
  }
}

TEST_CASE("the same seed gives the same effects and another seed others") {
  EffectsState first = slab_from_a_lorry(3), second = slab_from_a_lorry(3), other = slab_from_a_lorry(4);
  auto a = lorry_and_driver(), b = lorry_and_driver(), c = lorry_and_driver();
  run(a, first, 2, 160);
  run(b, second, 2, 160);
  run(c, other, 2, 160);
  CHECK(first.hash == second.hash);
  CHECK(first.published.keyframes == second.published.keyframes);
  CHECK(first.hash != other.hash);
}

TEST_CASE("what falls is carried where the scene's wind blows") {
  EffectsState state;
  put_on_lane(debris::Part::bumper, 6.0, state);
  const std::vector<Participant> nobody;
  Environment environment;
  environment.wind_speed_mps = 20.0;
  environment.wind_direction_rad = 2.0;
  for (Tick tick = 2; tick < 62; tick += effects_step_ticks)
    advance_effects({motorway(), nullptr, nobody, environment, 1, 1.0, tick, step_s}, state);
  REQUIRE(state.debris.pieces.size() == 1);
  const Vec3 speed_mps = debris::from_eigen(state.debris.pieces[0].body.velocity_mps.front());
  const Vec3 towards(std::cos(2.0), std::sin(2.0), 0.0);
  CHECK(glm::dot(speed_mps, towards) > 1.0);
}

TEST_CASE("a slab that lies on the road lifts the wheel that rolls over it") {
  EffectsState state;
  put_on_lane(debris::Part::ice_slab, 0.045, state);
  const Vec3 ground = on_motorway(900.0, -5).position_m;
  CHECK(obstacle_height_m(state, ground) == relative(0.085, 0.1));
  CHECK(obstacle_height_m(state, ground + Vec3(0.0, 5.0, 0.0)) == 0.0);
}

TEST_CASE("a car that hits another throws parts and no part twice") {
  EffectsState state;
  state.random = Random(1, 2);
  std::vector<Participant> participants{vehicle_on_lane(1, "volvo-s80", 900.0, -5, 22.0),
                                        vehicle_on_lane(7, "saloon", 904.4, -5, 2.0)};
  state.crashes.struck_vehicles = {struck(participants[0], participants[1])};
  const EffectsReport report = run(participants, state, 2, 2);
  CHECK(report.crashes.crashes == 1);
  CHECK(report.crashes.pieces > 2);
  REQUIRE(state.crashes.parts.contains(1));
  // Of each car whose windscreen is still in it the glass has starred.
  for (const ParticipantId id : {1u, 7u}) {
    const bool kept = std::ranges::any_of(
        state.crashes.parts[id], [](const debris::MountedPart& part) { return part.part == debris::Part::windscreen; });
    CHECK(std::ranges::count(state.ice.panes, id, &ice::Pane::vehicle) == (kept ? 1 : 0));
  }
  const auto all_parts = [&](std::size_t i) {
    return debris::passenger_car_parts(body_box(participants[i]).half_size_m);
  };
  CHECK(state.crashes.parts[1].size() < all_parts(0).size());
  // It hits the same car once more: loads and lying debris of both are unchanged.
  state.crashes.struck_vehicles = {struck(participants[0], participants[1])};
  CHECK(run(participants, state, 4, 2).crashes.crashes == 1);
  double thrown = 0.0;
  for (const debris::Piece& piece : state.debris.pieces) thrown += elastic::total_mass_kg(piece.body);
  for (const debris::Shard& shard : state.debris.shards) thrown += shard.mass_kg;
  CHECK(thrown + mass_kg(state.crashes.parts[1]) + mass_kg(state.crashes.parts[7]) ==
        relative(mass_kg(all_parts(0)) + mass_kg(all_parts(1)), 0.02));
}

TEST_CASE("two boxes touch where they are nearest and part along the shorter way") {
  debris::Box a, b;
  a.half_size_m = b.half_size_m = Vec3(2.0, 1.0, 0.75);
  b.world_from_box.position_m = {3.9, 0.5, 0.0};
  const auto ahead = contact_of(a, b);
  REQUIRE(ahead);
  CHECK(glm::length(ahead->normal - Vec3(-1.0, 0.0, 0.0)) < 1e-12);
  CHECK(ahead->depth_m == doctest::Approx(0.1));
  CHECK(ahead->point_m.x == doctest::Approx(1.95));
  b.world_from_box.position_m = {0.5, -1.9, 0.0};
  const auto beside = contact_of(a, b);
  REQUIRE(beside);
  CHECK(glm::length(beside->normal - Vec3(0.0, 1.0, 0.0)) < 1e-12);
  b.world_from_box.position_m = {0.5, -2.1, 0.0};
  CHECK_FALSE(contact_of(a, b));
  b.world_from_box.position_m = {0.0, 0.0, 1.6};
  CHECK_FALSE(contact_of(a, b));
  // Turned by 45 degrees it reaches farther: 2.0 m to its rounded corner.
  b.world_from_box = {{3.95, 0.0, 0.0}, orientation_from_angles(0.7853981633974483, 0.0, 0.0)};
  CHECK(contact_of(a, b));
  b.world_from_box.position_m.x = 4.05;
  CHECK_FALSE(contact_of(a, b));
}

TEST_CASE("a car that runs into what stands beside the road throws parts in the blow and none in a graze") {
  for (const double closing_mps : {2.0, 12.0}) {
    EffectsState state;
    state.random = Random(1, 2);
    std::vector<Participant> participants{vehicle_on_lane(1, "volvo-s80", 900.0, -5, 5.0)};
    const Participant& car = participants.front();
    const Vec3 forward = car.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
    vehicle::HullTouch touch;
    touch.point_m = car.world_from_vehicle * Vec3(3.7, 0.5, 0.5);
    touch.normal = -forward;
    touch.velocity_mps = closing_mps * forward;
    touch.closing_speed_mps = closing_mps;
    touch.mass_kg = 1545.0;
    state.crashes.struck_standing = {{1, touch}};
    const EffectsReport report = run(participants, state, 2, 2);
    CHECK(report.crashes.crashes == (closing_mps > 3.0 ? 1 : 0));
    CHECK((report.crashes.pieces > 0) == (closing_mps > 3.0));
    CHECK(state.crashes.struck_standing.empty());
    // The hull has taken the impact; only broken parts give something back.
    CHECK(glm::length(report.impulse_on_driver_ns) < 500.0);
  }
}

TEST_CASE("cones that the scenario sets up stand still and cost one keyframe each") {
  scenario::Scenario scenario;
  scenario::ScenarioState storyboard;
  for (int i = 0; i < 5; ++i) {
    scenario::Entity cone;
    cone.kind = scenario::EntityKind::misc_object;
    cone.type_name = "traffic-cone";
    scenario.entities.push_back(cone);
    scenario::EntityState where;
    where.active = true;
    where.world_from_entity = on_motorway(1000.0 + 5.0 * i, -5);
    storyboard.entities.push_back(where);
  }
  EffectsState state = initial_effects(scenario, storyboard, 1);
  REQUIRE(state.debris.pieces.size() == 5);
  std::vector<Participant> participants{vehicle_on_lane(1, "volvo-s80", 900.0, -5, 0.0)};
  run(participants, state, 2, 40);
  CHECK(state.published.keyframes.size() == 5);
  for (const EffectKeyframe& keyframe : state.published.keyframes) CHECK(keyframe.tick == 4);
  const EffectsReport later = run(participants, state, 42, 2);
  CHECK(later.published.fresh_bytes == 0);
}

TEST_CASE("a cone that is driven over flies") {
  EffectsState state;
  put_on_lane(debris::Part::traffic_cone, 0.252, state);
  state.debris.pieces.back().asleep = true;
  const Vec3 before = debris::from_eigen(state.debris.pieces.front().body.position_m.front());
  std::vector<Participant> participants{vehicle_on_lane(1, "volvo-s80", 893.0, -5, 22.0)};
  run(participants, state, 2, 60);
  REQUIRE(!state.debris.pieces.empty());
  CHECK(glm::length(debris::from_eigen(state.debris.pieces.front().body.position_m.front()) - before) > 1.0);
}

#include "engine/simulation/effects/fire_stage.hpp"

#include <algorithm>

#include <doctest/doctest.h>

#include "engine/effects/smoke/visibility.hpp"
#include "tests/engine/effects/smoke/puffs_of.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::simulation;
using road::motorway;

namespace {

Participant van_at(double s_m) {
  Participant van;
  van.id = 5;
  van.model = *find_vehicle_model("van");
  van.world_from_vehicle = road::world_from_lane(road::evaluate_lane(motorway(), {0, -6, s_m, 0.0}));
  return van;
}

Vec3 over_road(double s_m, double t_m, double up_m) {
  return road::evaluate(motorway(), {0, s_m, t_m}).position_m + Vec3(0.0, 0.0, up_m);
}

bool is_wall(const smoke::Grid& grid, const Vec3& world_m) {
  const Vec3 at = grid.grid_from_world(world_m);
  const int i = static_cast<int>(std::floor(at.x)), j = static_cast<int>(std::floor(at.y)),
            k = static_cast<int>(std::floor(at.z));
  return !grid.inside(i, j, k) || grid.wall[static_cast<std::size_t>(grid.index(i, j, k))] != 0;
}

FireState burn(double s_m, int steps, std::uint64_t seed) {
  const std::vector<Participant> participants{van_at(s_m)};
  FireState state;
  ignite(motorway(), participants.front(), seed, state);
  for (int i = 1; i <= steps; ++i)
    advance_fires(participants, {}, static_cast<Tick>(2 * i), i / 60.0, 1.0 / 60.0, state);
  return state;
}

}  // namespace

TEST_CASE("in a tunnel smoke has the tube of the driver's side as its room along the road's curve") {
  const smoke::Grid grid = grid_around(motorway(), van_at(3330.0).world_from_vehicle);
  for (const double s : {3240.0, 3330.0, 3420.0}) {
    CHECK_FALSE(is_wall(grid, over_road(s, -10.0, 2.0)));
    CHECK_FALSE(is_wall(grid, over_road(s, -10.0, 5.5)));
    CHECK_FALSE(is_wall(grid, over_road(s, -18.0, 1.5)));
    CHECK(is_wall(grid, over_road(s, 3.0, 2.0)));    // The other tube.
    CHECK(is_wall(grid, over_road(s, -10.0, 7.6)));  // Above the ceiling.
    CHECK(is_wall(grid, over_road(s, -10.0, -1.0)));
  }
}

TEST_CASE("a smoke keyframe names the tick from whose instant on it is shown") {
  // The fire begins at some later tick of the drive.
  const std::vector<Participant> participants{van_at(3330.0)};
  FireState state;
  ignite(motorway(), participants.front(), 1, state);
  for (Tick tick = 7200; tick <= 7500; tick += 2)
    advance_fires(participants, {}, tick, static_cast<double>(tick) / 120.0, 1.0 / 60.0, state);
  REQUIRE(!state.keyframes.empty());
  for (const EffectKeyframe& effect : state.keyframes) {
    if (effect.kind != smoke::keyframe_kind) continue;
    const auto keyframe = smoke::decode(effect.data);
    REQUIRE(keyframe);
    CHECK(keyframe->time_s == doctest::Approx(static_cast<double>(effect.tick) / 120.0));
    CHECK(effect.tick + 2 * smoke::keyframe_ticks > 7500);
  }
}

TEST_CASE("flames stand on the vehicle that burns within a second and in a tunnel as in the open") {
  for (const double s_m : {800.0, 3330.0})
    for (const int steps : {60, 180, 600}) {
      const FireState state = burn(s_m, steps, 3);
      const Vec3 fire = van_at(s_m).world_from_vehicle.position_m;
      const VehicleModel& van = vehicle_models()[van_at(s_m).model];
      const Vec3 below_seat = van_at(s_m).world_from_vehicle * Vec3(van.front_m() - 0.25 * van.length_m, 0.0, 0.0);
      double flames_m2 = 0.0, on_van_m2 = 0.0;
      for (const smoke::Puff& puff : smoke::puffs_of(state.keyframes, steps / 60.0)) {
        if (puff.glow < 0.2f) continue;
        flames_m2 += puff.extinction_area_m2;
        if (puff.position_m.z < fire.z + 4.5 && glm::length(glm::dvec2(puff.position_m - below_seat)) < 5.0)
          on_van_m2 += puff.extinction_area_m2;
      }
      CAPTURE(s_m);
      CAPTURE(steps);
      CAPTURE(flames_m2);
      // Two metres wide and two high, they hide a third of the picture behind them.
      CHECK(on_van_m2 > (steps < 100 ? 0.6 : 1.6));
      // Rising for 1.4 s at 2.5 m/s from 2.2 m up, 0.78 of them are below 4.5 m; the current under the roof bends the tips away.
      CHECK(on_van_m2 > 0.5 * flames_m2);
    }
}

TEST_CASE("soot of a fire in a tunnel is sent and lies over the fire") {
  const FireState state = burn(3330.0, 1500, 1);
  REQUIRE(!state.keyframes.empty());
  const EffectKeyframe& first = state.keyframes.front();
  REQUIRE(first.kind == smoke::soot_kind);
  CHECK(first.tick % 120 == 0);
  CHECK(std::ranges::is_sorted(state.keyframes, {}, &EffectKeyframe::id));
  const auto soot = smoke::decode_soot(first.data);
  REQUIRE(soot);
  MESSAGE("soot after 25 s: " << first.data.size() << " bytes, " << soot->level.size() << " cells, level "
                              << int(*std::ranges::max_element(soot->level)));
  const std::size_t most = static_cast<std::size_t>(std::ranges::max_element(soot->level) - soot->level.begin());
  const Vec3 place = soot->world_from_box * (Vec3(most % soot->nx + 0.5, most / soot->nx % soot->ny + 0.5,
                                                  most / (soot->nx * soot->ny) + 0.5) *
                                             static_cast<double>(soot->cell_m));
  const Vec3 fire = van_at(3330.0).world_from_vehicle.position_m;
  CHECK(place.z - fire.z > 3.0);
  CHECK(glm::length(Vec2(place - fire)) < 25.0);
}

TEST_CASE("a van that burns in a tunnel fills it from above and hides what lies behind") {
  const FireState state = burn(3330.0, 900, 1);
  REQUIRE(state.smoke);
  CHECK(state.smoke->particles.size() > 1500);
  double under_roof = 0.0, at_eyes = 0.0;
  for (double s = 3300.0; s <= 3360.0; s += 2.0)
    for (double t = -18.0; t <= -4.0; t += 2.0) {
      under_roof += smoke::extinction_per_m(*state.smoke, over_road(s, t, 4.9));
      at_eyes += smoke::extinction_per_m(*state.smoke, over_road(s, t, 1.2));
    }
  CHECK(under_roof > 2.0 * at_eyes);
  CHECK(smoke::transmittance(*state.smoke, over_road(3290.0, -15.0, 4.4), over_road(3370.0, -15.0, 4.4)) < 0.2);
}

TEST_CASE("a fire gives off the soot of its power") {
  // 2.5 MW, 1/6 MW a second more: 33.3 MJ in 10 s; 0.1 g of soot a gram at 25 MJ/kg, 8.7 m² a gram.
  const FireState state = burn(3330.0, 600, 1);
  const double burnt_mj = 2.5 * 10.0 + 0.5 * 0.1667 * 100.0;
  CHECK(state.smoke->ledger.emitted_m2 == relative(burnt_mj / 25.0 * 1000.0 * 0.1 * 8.7, 0.01));
  CHECK(state.smoke->refused == 0);
}

TEST_CASE("a tunnel's box of air ends at its portals") {
  const smoke::Grid grid = grid_around(motorway(), van_at(3330.0).world_from_vehicle);
  for (const double s : {3152.0, 3300.0, 3550.0, 3800.0, 3948.0}) CHECK_FALSE(is_wall(grid, over_road(s, -10.0, 2.0)));
  CHECK(std::abs(grid.nx - 800) < 10);
}

TEST_CASE("smoke keyframes are ascending and name their tick and stay within their share of a tick's bytes") {
  const FireState state = burn(3330.0, 300, 1);
  REQUIRE(!state.keyframes.empty());
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < state.keyframes.size(); ++i) {
    bytes += state.keyframes[i].data.size();
    CHECK(state.keyframes[i].tick > 600 - 2 * smoke::keyframe_ticks - 2);
    const auto& [id, kind, data, tick] = state.keyframes[i];
    CHECK((kind == smoke::soot_kind ? smoke::decode_soot(data).has_value() : smoke::decode(data).has_value()));
    if (i > 0) CHECK(state.keyframes[i - 1].id < state.keyframes[i].id);
  }
  CHECK(bytes < 140 * 1024);
}

TEST_CASE("the same seed gives the same smoke in the open") {
  const FireState a = burn(600.0, 120, 3), b = burn(600.0, 120, 3), c = burn(600.0, 120, 4);
  CHECK(a.keyframes == b.keyframes);
  CHECK_FALSE(a.keyframes == c.keyframes);
}

TEST_CASE("a fire that is put out gives off no more smoke") {
  FireState state = burn(600.0, 60, 3);
  const std::vector<Participant> participants{van_at(600.0)};
  const auto go_on = [&](int from) {
    for (int i = from; i < from + 60; ++i)
      advance_fires(participants, {}, static_cast<Tick>(2 * i), i / 60.0, 1.0 / 60.0, state);
  };
  const auto younger_than_a_second = [&] {
    return std::ranges::count_if(state.smoke->particles.age_s, [](float age_s) { return age_s < 0.99f; });
  };
  go_on(61);
  CHECK(younger_than_a_second() > 100);
  extinguish(5, state);
  go_on(121);
  CHECK(younger_than_a_second() == 0);
  CHECK(state.smoke->particles.size() > 0);  // Earlier emissions are still there.
}

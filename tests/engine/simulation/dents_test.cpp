// Vehicles dented by a crash, places and depths; and their announcement to all screens.

#include "engine/simulation/effects/dents.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "engine/simulation/effects/crashes.hpp"
#include "engine/simulation/effects/effects_stage.hpp"
#include "engine/world/snapshot.hpp"
#include "engine/world/wire_snapshot.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/engine/simulation/placed_participant.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::simulation;

namespace {

constexpr double undented_mps = 3.0, b1_per_s = 23.5;

const VehicleModel& model_of(const Participant& p) { return vehicle_models()[p.model]; }

CrashOutcome run_into(const std::vector<Participant>& both) {
  CrashMemory memory;
  memory.struck_vehicles = {struck(both[0], both[1])};
  debris::State debris;
  Random random(1);
  return advance_crashes(both, both[0].id, {}, memory, debris, random);
}

const debris::Dent* dent_of(const std::vector<MadeDent>& made, ParticipantId id) {
  const auto found = std::ranges::find(made, id, &MadeDent::vehicle);
  return found == made.end() ? nullptr : &found->dent;
}

double turned(double rad) { return std::remainder(rad, 2.0 * std::numbers::pi); }

}  // namespace

TEST_CASE("who runs into another is dented in front and the other behind, each for the speed that it loses") {
  // A van of 2400 kg, so the car of 1500 kg loses more.
  const double closing_mps = 20.0;
  std::vector<Participant> both{placed_participant(1, "volvo-s80", 0.0, 0.0, 0.0, closing_mps),
                                placed_participant(7, "van", 0.0, 0.3, 0.0, 0.0)};
  both[1].world_from_vehicle.position_m.x = model_of(both[0]).front_m() + model_of(both[1]).rear_overhang_m - 0.1;
  const CrashOutcome outcome = run_into(both);
  REQUIRE(outcome.dents.size() == 2);
  const debris::Dent *own = dent_of(outcome.dents, 1), *other = dent_of(outcome.dents, 7);
  REQUIRE(own);
  REQUIRE(other);
  CHECK(own->depth_m == doctest::Approx((closing_mps * 2400.0 / 3900.0 - undented_mps) / b1_per_s));
  CHECK(other->depth_m == doctest::Approx((closing_mps * 1500.0 / 3900.0 - undented_mps) / b1_per_s));
  CHECK(own->place_m.x == doctest::Approx(model_of(both[0]).front_m()));
  CHECK(std::abs(turned(own->heading_rad - std::numbers::pi)) < 1e-9);
  CHECK(other->place_m.x == doctest::Approx(-model_of(both[1]).rear_overhang_m));
  CHECK(std::abs(turned(other->heading_rad)) < 1e-9);
  // As wide as both overlap: the van's right edge is at −0.71 m, the car's left one at 0.9155 m.
  const double right = 0.3 - 0.5 * model_of(both[1]).width_m, left = 0.5 * model_of(both[0]).width_m;
  CHECK(own->half_width_m == doctest::Approx(0.5 * (left - right)));
  CHECK(own->place_m.y == doctest::Approx(0.5 * (left + right)));
  CHECK(other->place_m.y == doctest::Approx(0.5 * (left + right) - 0.3));
  // The van is met behind, all of its height; the car with its bonnet.
  CHECK(own->top_m == doctest::Approx(model_of(both[0]).height_m));
  CHECK(other->top_m == doctest::Approx(0.55 * model_of(both[0]).height_m));
}

TEST_CASE("who is run into from the side is dented there, in his own frame whichever way he stands") {
  for (const double heading : {0.0, 2.0, -1.2}) {
    CAPTURE(heading);
    // The driver comes from the other's left, at its middle.
    std::vector<Participant> both{placed_participant(1, "volvo-s80", 0.0, 0.0, heading - 0.5 * std::numbers::pi, 15.0),
                                  placed_participant(7, "saloon", 40.0, -7.0, heading, 0.0)};
    const VehicleModel &striker = model_of(both[0]), &struck = model_of(both[1]);
    const Vec3 nose = both[1].world_from_vehicle * Vec3(struck.centre_x_m(), 0.5 * struck.width_m - 0.05, 0.0);
    both[0].world_from_vehicle.position_m =
        nose - both[0].world_from_vehicle.orientation * Vec3(striker.front_m(), 0, 0);
    const CrashOutcome outcome = run_into(both);
    const debris::Dent* side = dent_of(outcome.dents, 7);
    REQUIRE(side);
    CHECK(side->place_m.x == relative(struck.centre_x_m(), 0.02));
    CHECK(side->place_m.y == doctest::Approx(0.5 * struck.width_m));
    CHECK(std::abs(turned(side->heading_rad + 0.5 * std::numbers::pi)) < 1e-6);
    CHECK(side->half_width_m == doctest::Approx(0.5 * striker.width_m));
    CHECK(side->depth_m == doctest::Approx((7.5 - undented_mps) / b1_per_s));
    REQUIRE(dent_of(outcome.dents, 1));
    CHECK(std::abs(turned(dent_of(outcome.dents, 1)->heading_rad - std::numbers::pi)) < 1e-6);
  }
}

TEST_CASE("a corner that strikes is dented at the corner") {
  std::vector<Participant> both{placed_participant(1, "volvo-s80", 0.0, 0.0, 0.5, 14.0),
                                placed_participant(7, "lorry", 0.0, 0.0, 0.0, 0.0)};
  const VehicleModel& car = model_of(both[0]);
  // Its left front corner in the lorry's right side.
  const Vec3 corner_m = both[0].world_from_vehicle * Vec3(car.front_m(), 0.5 * car.width_m, 0.0);
  both[1].world_from_vehicle.position_m =
      corner_m + Vec3(-model_of(both[1]).centre_x_m(), 0.5 * model_of(both[1]).width_m - 0.2, 0.0);
  both[0].velocity_mps = {0.0, 12.0, 0.0};
  const CrashOutcome outcome = run_into(both);
  const debris::Dent* own = dent_of(outcome.dents, 1);
  REQUIRE(own);
  CHECK(own->place_m.x > car.front_m() - 0.8);
  CHECK(own->place_m.y > 0.0);
  CHECK(own->half_width_m < 1.2);
  CHECK_FALSE(dent_of(outcome.dents, 7));  // Sixteen tonnes lose 1 m/s.
}

TEST_CASE("a trunk dents as wide as it is, a wall all of the front, and what yields not at all") {
  const Participant car = placed_participant(1, "volvo-s80", 100.0, 50.0, 0.7, 0.0);
  vehicle::HullTouch touch;
  touch.point_m = car.world_from_vehicle * Vec3(model_of(car).front_m(), 0.5, 0.5);
  touch.normal = car.world_from_vehicle.orientation * Vec3(-1.0, 0.0, 0.0);
  touch.closing_speed_mps = 12.0;
  struct Row {
    ObstacleKind kind;
    double half_width_m, y_m, top_m;
  };
  const double half_m = 0.5 * model_of(car).width_m;
  for (const Row& row : {Row{ObstacleKind::tree, 0.2, 0.5, model_of(car).height_m},
                         Row{ObstacleKind::post, 0.08, 0.5, model_of(car).height_m},
                         Row{ObstacleKind::tunnel_wall, half_m, 0.0, model_of(car).height_m},
                         Row{ObstacleKind::guard_rail, half_m, 0.0, 0.75}}) {
    touch.kind = row.kind;
    const auto made = dents_of_touch(car, touch);
    REQUIRE(made.size() == 1);
    const debris::Dent& dent = made[0].dent;
    CHECK(dent.depth_m == doctest::Approx((12.0 - undented_mps) / b1_per_s));
    CHECK(dent.half_width_m == doctest::Approx(row.half_width_m));
    CHECK(dent.place_m.x == doctest::Approx(model_of(car).front_m()));
    CHECK(dent.place_m.y == doctest::Approx(row.y_m));
    CHECK(dent.top_m == doctest::Approx(row.top_m));
  }
  for (const ObstacleKind kind : {ObstacleKind::marker_post, ObstacleKind::bush}) {
    touch.kind = kind;
    CHECK(dents_of_touch(car, touch).empty());
  }
  touch.kind = ObstacleKind::tree;
  touch.closing_speed_mps = 2.5;
  CHECK(dents_of_touch(car, touch).empty());
}

TEST_CASE("people and who is on two wheels leave the car its shape, and have none to lose") {
  for (const char* model : {"pedestrian", "bicycle", "motorcycle"}) {
    CAPTURE(model);
    std::vector<Participant> both{placed_participant(1, "volvo-s80", 0.0, 0.0, 0.0, 14.0),
                                  placed_participant(7, model, 0.0, 0.0, 0.0, 0.0)};
    both[1].world_from_vehicle.position_m.x = model_of(both[0]).front_m() + model_of(both[1]).rear_overhang_m - 0.05;
    CHECK(run_into(both).dents.empty());
  }
}

TEST_CASE("a crash's dents are in every snapshot from then on, for who joins late too, until the vehicle has left") {
  const RigidTransform lane = road::world_from_lane(road::evaluate_lane(road::motorway(), {0, -5, 810.0, 0.0}));
  std::vector<Participant> participants{placed_participant(1, "volvo-s80", 0, 0, 0, 0),
                                        placed_participant(7, "saloon", 0, 0, 0, 0)};
  for (Participant& p : participants) p.world_from_vehicle = lane;
  participants[0].velocity_mps = lane.orientation * Vec3(20.0, 0.0, 0.0);
  participants[1].world_from_vehicle.position_m =
      lane * Vec3(model_of(participants[0]).front_m() + model_of(participants[1]).rear_overhang_m - 0.1, 0.0, 0.0);
  EffectsState state;
  state.random = Random(3, 2);
  state.crashes.struck_vehicles = {struck(participants[0], participants[1])};
  const Environment environment;
  const auto advance = [&](Tick tick) {
    return advance_effects({road::motorway(), nullptr, participants, environment, 1, 1.0, tick, 1.0 / 120.0}, state);
  };
  const auto dents_in = [](const std::vector<EffectKeyframe>& keyframes) {
    const auto found = std::ranges::find(keyframes, debris::dent_effect_id, &EffectKeyframe::id);
    REQUIRE(found != keyframes.end());
    CHECK(found->kind == debris::dent_keyframe_kind);
    return *found;
  };
  CHECK(effect_keyframes(state).empty());
  advance(100);
  const EffectKeyframe first = dents_in(effect_keyframes(state));
  CHECK(first.tick == 102);
  for (Tick tick = 102; tick < 140; tick += effects_step_ticks) advance(tick);
  CHECK(dents_in(effect_keyframes(state)) == first);  // Once on the wire, and then no more.
  // A late screen gets it from a snapshot without a baseline.
  Snapshot snapshot;
  snapshot.tick = 140;
  snapshot.participants = participants;
  snapshot.effects = effect_keyframes(state);
  CHECK(std::ranges::is_sorted(snapshot.effects, {}, &EffectKeyframe::id));
  Bytes bytes;
  encode_snapshot(to_wire(snapshot), nullptr, bytes);
  const auto told = decode_snapshot(bytes, nullptr);
  REQUIRE(told);
  const auto dents = debris::decode_dents(dents_in(from_wire(*told).effects).data);
  REQUIRE(dents);
  REQUIRE(dents->size() == 2);
  for (const debris::DentedVehicle& told_of : *dents) {
    debris::Mounts mounted = 0;
    for (const debris::MountedPart& part : state.crashes.parts.at(told_of.vehicle))
      mounted |= debris::bit_of(part.mount);
    CHECK(told_of.torn != 0);
    CHECK((told_of.torn ^ mounted) == (1u << debris::mount_count) - 1u);  // Either on the vehicle, or not.
  }
  CHECK(dents->at(0).dents.at(0).depth_m == relative((10.0 - undented_mps) / b1_per_s, 0.02));
  participants.pop_back();
  advance(140);
  const auto left = debris::decode_dents(dents_in(effect_keyframes(state)).data);
  REQUIRE(left);
  REQUIRE(left->size() == 1);
  CHECK(left->at(0).vehicle == 1);
}

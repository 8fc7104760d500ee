#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/server_step.hpp"
#include "tests/engine/simulation/saved_and_restored.hpp"
#include "tests/relative.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::simulation {
namespace {

std::optional<CrashRecord> record_among(const std::vector<Event>& events) {
  const auto found = std::ranges::find(events, crash_event, &Event::kind);
  return found == events.end() ? std::nullopt : read_crash(*found->participant, found->detail);
}

}  // namespace

TEST_CASE("a vehicle that the driver's car touches is one collision for as long as they touch") {
  const server::LoadedDrive drive = server::shipped_drive("behind-ambulance", "desktop");
  auto state = initial_state(*drive.model, traffic::own_traffic(drive.model->roads, 1));
  REQUIRE(state.has_value());
  std::vector<Event> events;
  const auto collisions = [&] { return std::ranges::count(events, "collision", &Event::kind); };
  const Snapshot before = server_step(*drive.model, {}, *state, events);
  CHECK(collisions() == 0);
  CHECK(before.diagnostics.collisions == 0);

  const Participant* car = find_participant(before, driver_participant);
  REQUIRE(car != nullptr);
  const auto distance_m = [&](const Participant& p) {
    return p.id == car->id ? INFINITY
                           : glm::length(p.world_from_vehicle.position_m - car->world_from_vehicle.position_m);
  };
  const Participant other = *std::ranges::min_element(before.participants, {}, distance_m);
  // On a bridge above the other one nothing touches.
  const Vec3 there_m =
      state->car.world_from_body.position_m + other.world_from_vehicle.position_m - car->world_from_vehicle.position_m;
  state->car.world_from_body.position_m = there_m + Vec3(0.0, 0.0, 6.0);
  state->car.velocity_mps = other.velocity_mps;
  CHECK(server_step(*drive.model, {}, *state, events).diagnostics.collisions == 0);

  state->car.world_from_body.position_m = there_m;
  for (int tick = 0; tick < 10; ++tick) {
    const Snapshot now = server_step(*drive.model, {}, *state, events);
    CHECK(now.diagnostics.collisions == 1);
  }
  CHECK(collisions() == 1);
  const auto event = std::ranges::find(events, "collision", &Event::kind);
  REQUIRE(event != events.end());
  CHECK(event->participant == other.id);
}

TEST_CASE("a drive that is saved while the car runs into traffic goes on with the same hashes, and traffic loses it") {
  const server::LoadedDrive drive = server::shipped_drive("behind-ambulance", "desktop");
  auto state = initial_state(*drive.model, traffic::own_traffic(drive.model->roads, 1));
  REQUIRE(state.has_value());
  std::vector<Event> events;
  const Snapshot before = server_step(*drive.model, {}, *state, events);
  const Participant* car = find_participant(before, driver_participant);
  REQUIRE(car != nullptr);
  const auto other = std::ranges::find_if(before.participants, [&](const Participant& p) {
    return p.id != car->id && vehicle_models()[p.model].kind == ParticipantKind::car &&
           glm::length(p.velocity_mps) > 10.0;
  });
  REQUIRE(other != before.participants.end());
  // Behind it on its lane, turned as it is, and 12 m/s faster.
  const Quat turn = other->world_from_vehicle.orientation;
  const Vec3 way = turn * Vec3(1.0, 0.0, 0.0);
  const double apart_m = vehicle_models()[car->model].front_m() + vehicle_models()[other->model].rear_overhang_m + 0.3;
  const RigidTransform body_from_vehicle = inverse(car->world_from_vehicle) * state->car.world_from_body;
  state->car.world_from_body =
      RigidTransform{other->world_from_vehicle.position_m - apart_m * way, turn} * body_from_vehicle;
  state->car.velocity_mps = other->velocity_mps + 12.0 * way;
  const ParticipantId struck = other->id;
  const auto runs = [&] {
    return std::ranges::any_of(state->bodies.contacts,
                               [](const BodyContact& contact) { return !contact.engagement.pulses.empty(); });
  };
  for (int i = 0; i < 20 && !runs(); ++i) server_step(*drive.model, {}, *state, events);
  for (int i = 0; i < 3; ++i) server_step(*drive.model, {}, *state, events);
  REQUIRE(runs());
  std::vector<Participant> of_traffic;
  state->traffic->append_participants(of_traffic);
  CHECK(std::ranges::find(of_traffic, struck, &Participant::id) == of_traffic.end());
  CHECK(find_loose(*state, struck) != nullptr);

  auto again = saved_and_restored(*drive.model, *state);
  CHECK(hash_state(again) == hash_state(*state));
  std::vector<Event> others;
  Snapshot last;
  bool has_ended = false;  // Others may run into them afterwards.
  for (int i = 0; i < 240; ++i) {
    last = server_step(*drive.model, {}, *state, events);
    has_ended = has_ended || !runs();
    CHECK(server_step(*drive.model, {}, again, others).state_hash == last.state_hash);
  }
  CHECK(has_ended);
  CHECK(find_participant(last, struck) != nullptr);
  const auto event = std::ranges::find(events, "collision", &Event::kind);
  REQUIRE(event != events.end());
  const double told_mps = std::stod(event->detail.substr(event->detail.find("delta_v_mps=") + 12));
  CHECK(told_mps > 5.0);
  // Saved in the middle, the record is the same; what broke off is in its ledger.
  const auto record = record_among(events);
  REQUIRE(record.has_value());
  CHECK(record_among(others) == record);
  CHECK(record->second == struck);
  REQUIRE(record->ledger.has_value());
  CHECK(record->pieces_kinetic_j.value_or(0.0) > 0.0);
  CHECK(record->ledger->debris_j != 0.0);
  MESSAGE(text_of(*record) << "; missing " << share_missing(*record->ledger));
  CHECK(share_missing(*record->ledger) < 0.001);
  CHECK(glm::length(*record->of_first.delta_v_mps) == relative(told_mps, 0.2));
}

TEST_CASE("a drive that is saved while the car crashes into a barrier goes on with the same hashes") {
  const server::LoadedDrive drive = server::shipped_drive("behind-ambulance", "desktop");
  auto state = initial_state(*drive.model, traffic::own_traffic(drive.model->roads, 1));
  REQUIRE(state.has_value());
  state->traffic->stop();
  const auto listed = drive.model->obstacles->listed();
  const auto rail = std::ranges::find_if(listed, [&](const Obstacle& obstacle) {
    return obstacle.kind == ObstacleKind::guard_rail &&
           road::locate(drive.model->roads, obstacle.from_m, nullptr, 40.0).has_value();
  });
  REQUIRE(rail != listed.end());
  const Vec2 along = glm::normalize(rail->to_m - rail->from_m), across(-along.y, along.x);
  const Vec2 origin_m = 0.5 * (rail->from_m + rail->to_m) - 7.0 * across;
  const auto ground = road::surface_at(drive.model->roads, origin_m, nullptr, 400.0);
  state->car = vehicle::standstill(drive.model->car,
                                   {Vec3(origin_m, ground ? ground->height_m : 0.0),
                                    orientation_from_angles(std::atan2(across.y, across.x) + 0.3, 0.0, 0.0)},
                                   20.0);
  state->car_road.reset();
  std::vector<Event> events;
  const auto runs = [&] {
    return std::ranges::any_of(state->hull.touches,
                               [](const vehicle::HullTouch& touch) { return !touch.engagement.pulses.empty(); });
  };
  for (int i = 0; i < 60 && !runs(); ++i) server_step(*drive.model, {}, *state, events);
  for (int i = 0; i < 2; ++i) server_step(*drive.model, {}, *state, events);
  REQUIRE(runs());

  auto again = saved_and_restored(*drive.model, *state);
  CHECK(hash_state(again) == hash_state(*state));
  std::vector<Event> others;
  for (int i = 0; i < 120; ++i) {
    const std::uint64_t one = server_step(*drive.model, {}, *state, events).state_hash;
    CHECK(server_step(*drive.model, {}, again, others).state_hash == one);
  }
  CHECK(!runs());
  CHECK(std::ranges::count(events, "collision", &Event::kind) > 0);
  const auto record = record_among(events);
  REQUIRE(record.has_value());
  CHECK(record_among(others) == record);
  CHECK(record->stands == "guard rail");
  CHECK_FALSE(record->of_second.mass_kg.has_value());
  REQUIRE(record->ledger.has_value());
  MESSAGE(text_of(*record) << "; missing " << share_missing(*record->ledger));
  CHECK(share_missing(*record->ledger) < 0.001);
  CHECK(record->of_first.crush_m.value_or(0.0) > 0.05);
  // Whence it came is the rail's side of the car.
  const double wall_rad = record->normal_rad - std::atan2(across.y, across.x) - 0.3;
  CHECK(std::abs(std::remainder(*record->of_first.principal_direction_rad - wall_rad, 6.283185307179586)) < 0.7);
}

}  // namespace septet::simulation

#include "sim-client/frame/tick_history.hpp"

#include <doctest/doctest.h>

#include "engine/scenery/vehicles/eye_point.hpp"
#include "sim-client/frame/viewpoint.hpp"

using namespace septet;
using namespace septet::frame;

namespace {

WireSnapshot wire_of(Tick tick) {
  Snapshot snapshot;
  snapshot.tick = tick;
  snapshot.simulated_time_s = static_cast<double>(tick) / 120.0;
  snapshot.state_hash = tick;
  return to_wire(snapshot);
}

Bytes payload_of(Tick tick, std::optional<Tick> baseline = {}) {
  Bytes bytes;
  ByteWriter writer(bytes);
  control::put_tick_header(writer, {.published_s = 1.0});
  const WireSnapshot before = wire_of(baseline.value_or(0));
  encode_snapshot(wire_of(tick), baseline ? &before : nullptr, bytes);
  return bytes;
}

using Outcome = TickHistory::Outcome;

}  // namespace

TEST_CASE("a history keeps the newest ninety-six ticks and no more") {
  TickHistory history;
  CHECK(history.add(payload_of(1)) == Outcome::stored);
  for (Tick tick = 2; tick <= 1000; ++tick) CHECK(history.add(payload_of(tick, tick - 1)) == Outcome::stored);
  CHECK(history.ticks().size() == TickHistory::kept);
  CHECK(history.newest().snapshot.tick == 1000);
  CHECK(history.find(1000 - TickHistory::kept) == nullptr);
  REQUIRE(history.find(1001 - TickHistory::kept) != nullptr);
  CHECK(history.find(1000)->snapshot.state_hash == 1000);
  history.clear();
  CHECK(history.empty());
}

TEST_CASE("a difference whose baseline is not there is a lost baseline and not a damaged one") {
  TickHistory history;
  CHECK(history.add(payload_of(10)) == Outcome::stored);
  CHECK(history.add(payload_of(12, 11)) == Outcome::lost_baseline);
  CHECK(history.add(payload_of(12, 10)) == Outcome::stored);
  CHECK(history.add(payload_of(12, 11)) == Outcome::stored);  // It is there already.
  CHECK(history.ticks().size() == 2);
}

TEST_CASE("damaged ticks are refused with a reason and change nothing") {
  TickHistory history;
  const Bytes good = payload_of(10);
  CHECK(history.add(std::span(good).first(3)) == Outcome::refused);
  CHECK(history.error().what == "malformed header");
  CHECK(history.add(std::span(good).first(good.size() - 1)) == Outcome::refused);
  CHECK_FALSE(history.error().what.empty());
  CHECK(history.empty());
}

TEST_CASE("ticks that come late take their place and neighbours are found by time") {
  TickHistory history;
  for (const Tick tick : {10, 14, 12}) CHECK(history.add(payload_of(tick)) == Outcome::stored);
  CHECK(history.newest().snapshot.tick == 14);
  const auto around = [&](double tick) { return history.around(tick / 120.0); };
  CHECK(around(9.0).before == nullptr);
  CHECK(around(9.0).after->snapshot.tick == 10);
  CHECK(around(13.0).before->snapshot.tick == 12);
  CHECK(around(13.0).after->snapshot.tick == 14);
  CHECK(around(12.0).before->snapshot.tick == 12);  // At or before.
  CHECK(around(15.0).before->snapshot.tick == 14);
  CHECK(around(15.0).after == nullptr);
}

TEST_CASE("a screen looks out of the driver's car and where there is none out of the first one") {
  Snapshot shown;
  CHECK(driver_viewpoint(shown).inside.has_value() == false);
  for (const ParticipantId id : {3, 5}) {
    Participant vehicle;
    vehicle.id = id;
    vehicle.world_from_vehicle.position_m.x = id;
    shown.participants.push_back(vehicle);
  }
  CHECK(driver_viewpoint(shown).inside == 3);
  shown.driver_car.participant = 5;
  CHECK(driver_viewpoint(shown).inside == 5);
  CHECK(driver_viewpoint(shown).world_from_views.position_m.x == 5.0);
}

TEST_CASE("drivers sit on the left below the roof and ahead of the rear axle, and riders in the middle") {
  for (const VehicleModel& model : vehicle_models()) {
    CAPTURE(model.name);
    const Vec3 eye = scenery::eye_in(model);
    const bool seated = model.kind == ParticipantKind::car || model.kind == ParticipantKind::van ||
                        model.kind == ParticipantKind::ambulance || model.kind == ParticipantKind::lorry ||
                        model.kind == ParticipantKind::bus;
    const bool in_the_middle = model.name == "farm-tractor";
    const bool is_towed = model.name == "caravan" || model.name == "semitrailer";  // Nobody drives it.
    if (seated && !in_the_middle && !is_towed) {
      CHECK(eye.y > 0.1 * model.width_m);
      CHECK(eye.y < 0.4 * model.width_m);
      CHECK(eye.z < model.height_m - 0.1);
      CHECK(eye.x > 0.0);
    } else {
      CHECK(eye.y == 0.0);
    }
    CHECK(eye.x < model.front_m());
    CHECK((eye.z > 1.0 || model.kind == ParticipantKind::object));
  }
}

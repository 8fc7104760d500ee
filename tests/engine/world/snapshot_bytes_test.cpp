// The bytes and the bounds that SNAPSHOT.md promises.

#include <cmath>

#include <doctest/doctest.h>

#include "engine/world/indicator.hpp"
#include "engine/world/wire_snapshot.hpp"
#include "tests/relative.hpp"

namespace septet {
namespace {

/// One vehicle at rest except for the tests' changes, at an instant.
Snapshot instant(Tick tick, double time_s) {
  Snapshot snapshot;
  snapshot.tick = tick;
  snapshot.simulated_time_s = time_s;
  Participant vehicle;
  vehicle.id = 4;
  vehicle.model = 1;
  snapshot.participants = {vehicle};
  return snapshot;
}

Participant received(const Participant& sent) {
  Snapshot snapshot;
  snapshot.participants = {sent};
  return from_wire(to_wire(snapshot)).participants.front();
}

}  // namespace

TEST_CASE("a difference has the bytes of the specification and is taken to the vehicle moved on by half a t squared") {
  Snapshot before = instant(10, 2.0);
  Participant& vehicle = before.participants.front();
  vehicle.world_from_vehicle.position_m = {100.0, -20.0, 0.0};
  vehicle.velocity_mps = {8.0, 0.0, 0.0};
  vehicle.acceleration_mps2 = {4.0, -2.0, 0.0};
  vehicle.wheel_spin_radps = 0.0;
  Snapshot after = instant(70, 2.5);
  Participant& moved = after.participants.front();
  // 8 m/s · 0.5 s + 4 m/s² · (0.5 s)² / 2, and five steps more than that.
  moved.world_from_vehicle.position_m = {100.0 + 4.0 + 0.5 + 5.0 / 4096.0, -20.0 - 0.25, 0.0};
  moved.velocity_mps = {10.0, -1.0, 0.0};
  moved.acceleration_mps2 = {4.0, -2.0, 0.0};
  after.state_hash = 0x1122334455667788u;
  after.driver_car.participant = 300;
  after.driver_car.gear = -1;
  after.driver_car.road = 2;
  after.driver_car.lane = -5;
  after.driver_car.speed_mps = 0.25;
  after.driver_car.lane_width_m = 3.5;
  after.diagnostics = {1, 2, 3};

  Bytes expected;
  ByteWriter writer(expected);
  for (const int byte : {2, 1, 70, 60})
    writer.put(static_cast<std::uint8_t>(byte));  // Version, flags, tick, age of the baseline.
  writer.put(2.5);
  writer.put(std::uint64_t{0x1122334455667788u});
  for (const int byte : {0xac, 0x02, 0x01, 0x02, 0x09}) writer.put(static_cast<std::uint8_t>(byte));
  writer.put(0.25);
  for (int i = 0; i < 10; ++i) writer.put(0.0);
  writer.put(3.5);
  for (const int byte : {1, 2, 3}) writer.put(static_cast<std::uint8_t>(byte));
  // No removals; one changed, id 4, the fourth field, by five; no effects removed, none changed.
  for (const int byte : {0, 1, 4, 1 << field_position_x, 10, 0, 0}) writer.put(static_cast<std::uint8_t>(byte));

  const WireSnapshot wire_before = to_wire(before);
  Bytes bytes;
  encode_snapshot(to_wire(after), &wire_before, bytes);
  CHECK(bytes == expected);
  const auto decoded = decode_snapshot(expected, &wire_before);
  REQUIRE(decoded.has_value());
  const Participant shown = from_wire(*decoded).participants.front();
  CHECK(shown.world_from_vehicle.position_m == moved.world_from_vehicle.position_m);
  CHECK(shown.velocity_mps == Vec3(10.0, -1.0, 0.0));
  CHECK(decoded->rest.driver_car.gear == -1);
  CHECK(decoded->rest.driver_car.lane == -5);
  CHECK(decoded->rest.diagnostics == after.diagnostics);
}

TEST_CASE("nobody is moved on by more than a second and wheels turn on over a whole turn") {
  const double turn = 2.0 * 3.14159265358979323846, rate_radps = 201.0 / 64.0;
  Snapshot before = instant(10, 2.0), after = instant(400, 5.25);
  before.participants[0].velocity_mps = after.participants[0].velocity_mps = {4.0, 0.0, 0.0};
  before.participants[0].wheel_spin_radps = after.participants[0].wheel_spin_radps = rate_radps;
  before.participants[0].wheel_spin_rad = 0.75 * turn;
  const WireSnapshot wire_before = to_wire(before);
  const auto bytes_with = [&](double x_m, double spin_steps) {
    after.participants[0].world_from_vehicle.position_m.x = x_m;
    after.participants[0].wheel_spin_rad = spin_steps / 65536.0 * turn;
    Bytes bytes;
    encode_snapshot(to_wire(after), &wire_before, bytes);
    return bytes.size();
  };
  // In one second of the 3.25 it goes 4 m, and its wheels half a turn, to a quarter of the next one.
  const double steps = std::floor(std::fmod(0.75 + rate_radps / turn, 1.0) * 65536.0 + 0.5) + 0.5;
  const std::size_t foreseen = bytes_with(4.0, steps);
  CHECK(bytes_with(4.0 + 1.0 / 4096.0, steps) > foreseen);
  CHECK(bytes_with(4.0, steps + 1.0) > foreseen);
}

TEST_CASE("every number of a participant stays within half a step of what was sent") {
  Participant sent;
  sent.id = 9;
  sent.model = 3;
  sent.paint = 200;
  sent.lamps.bits = 0x155;
  sent.acceleration_mps2 = {1.2345, -6.789, 0.4321};
  sent.angular_velocity_radps = {0.12345, -0.6789, 1.4321};
  sent.front_steer_rad = -0.34567;
  sent.wheel_spin_rad = 5.4321;
  sent.wheel_spin_radps = -77.77;
  sent.wheel_lift_m = {0.0123, -0.0345, 0.0567, -0.0789};
  const Participant got = received(sent);
  CHECK(got.model == 3);
  CHECK(got.paint == 200);
  CHECK(got.lamps == sent.lamps);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(std::abs(got.acceleration_mps2[axis] - sent.acceleration_mps2[axis]) <= 0.5 / 256);
    CHECK(std::abs(got.angular_velocity_radps[axis] - sent.angular_velocity_radps[axis]) <= 0.5 / 16384);
  }
  CHECK(std::abs(got.front_steer_rad - sent.front_steer_rad) <= 0.5 / 16384);
  CHECK(std::abs(got.wheel_spin_rad - sent.wheel_spin_rad) <= 6.2832 / 65536);
  CHECK(std::abs(got.wheel_spin_radps - sent.wheel_spin_radps) <= 0.5 / 64);
  for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(got.wheel_lift_m[i] - sent.wheel_lift_m[i]) <= 0.5 / 4096);
}

TEST_CASE("what is out of bounds is sent as the bound and a number gone bad as zero") {
  Participant sent;
  sent.world_from_vehicle.position_m = {1e9, -1e9, std::nan("")};
  sent.velocity_mps = {5000.0, -INFINITY, 1.0};
  sent.wheel_lift_m = {99.0, 0.0, 0.0, 0.0};
  const Participant got = received(sent);
  CHECK(got.world_from_vehicle.position_m.x == relative(524288.0, 1e-8));
  CHECK(got.world_from_vehicle.position_m.x < 524288.0);
  CHECK(got.world_from_vehicle.position_m.y == -got.world_from_vehicle.position_m.x);
  CHECK(got.world_from_vehicle.position_m.z == 0.0);
  CHECK(got.velocity_mps == Vec3(1024.0, 0.0, 1.0));
  CHECK(got.wheel_lift_m[0] == 16.0);
}

TEST_CASE("an orientation comes back whichever of its components is largest and whatever its sign") {
  for (int largest = 0; largest < 4; ++largest)
    for (const double sign : {1.0, -1.0}) {
      double q[] = {0.1, -0.2, 0.3, 0.4};
      q[largest] = sign * 2.0;
      Participant sent;
      sent.world_from_vehicle.orientation = glm::normalize(Quat(q[0], q[1], q[2], q[3]));
      const Quat got = received(sent).world_from_vehicle.orientation;
      CHECK(std::abs(glm::dot(got, sent.world_from_vehicle.orientation)) > 1.0 - 1e-11);
    }
}

TEST_CASE("an effect may be ahead of its snapshot by sixty-four ticks and old without end") {
  Snapshot snapshot = instant(1000, 1.0);
  snapshot.effects = {{1, 1, Bytes(3), 1000 + max_effect_lead_ticks}, {2, 1, Bytes(3), 0}};
  Bytes bytes;
  encode_snapshot(to_wire(snapshot), nullptr, bytes);
  const auto decoded = decode_snapshot(bytes, nullptr);
  REQUIRE(decoded.has_value());
  CHECK(decoded->rest.effects == snapshot.effects);
}

TEST_CASE("indicators flash eighty-six times a minute and are lit for 0.37 of 0.7 seconds") {
  CHECK(indicator_is_lit(0.0));
  CHECK(indicator_is_lit(0.369));
  CHECK_FALSE(indicator_is_lit(0.371));
  CHECK_FALSE(indicator_is_lit(0.699));
  CHECK(indicator_is_lit(0.701));
  int flashes = 0;
  for (int ms = 1; ms <= 60'000; ++ms) flashes += indicator_is_lit(0.001 * ms) && !indicator_is_lit(0.001 * (ms - 1));
  CHECK(flashes == 85);  // The first one began with the minute.
  CHECK(indicator_is_lit(0.3, 7) != indicator_is_lit(0.3, 8));
}

}  // namespace septet

#include "engine/world/wire_snapshot.hpp"

#include <cmath>
#include <utility>

#include <doctest/doctest.h>
#include <glm/gtc/constants.hpp>

#include "engine/core/random.hpp"
#include "engine/world/participant_quantisation.hpp"

namespace septet {
namespace {

Snapshot random_snapshot(Random& random, Tick tick, std::size_t participants) {
  Snapshot snapshot;
  snapshot.tick = tick;
  snapshot.simulated_time_s = static_cast<double>(tick) / 120.0;
  snapshot.state_hash = random.next_bits();
  snapshot.driver_car.participant = 1;
  snapshot.driver_car.lateral_position_m = random.normal();
  const auto vector = [&](double size) { return Vec3(random.normal(), random.normal(), random.normal()) * size; };
  for (std::size_t i = 0; i < participants; ++i) {
    Participant p;
    p.id = static_cast<ParticipantId>(1 + 3 * i);
    p.model = static_cast<ModelIndex>(random.below(vehicle_models().size()));
    p.world_from_vehicle.position_m = vector(1e4);
    p.world_from_vehicle.orientation =
        glm::normalize(Quat(random.normal(), random.normal(), random.normal(), random.normal()));
    p.velocity_mps = vector(30.0);
    p.acceleration_mps2 = vector(2.0);
    p.angular_velocity_radps = vector(0.3);
    p.front_steer_rad = random.uniform(-0.5, 0.5);
    p.wheel_spin_rad = random.uniform(0.0, 6.28);
    p.wheel_spin_radps = random.uniform(-100.0, 100.0);
    snapshot.participants.push_back(p);
  }
  return snapshot;
}

double angle_between(const Quat& a, const Quat& b) {
  const Quat turn = glm::conjugate(a) * b;
  return 2.0 * std::asin(std::min(1.0, glm::length(Vec3(turn.x, turn.y, turn.z))));
}

bool same(const WireSnapshot& a, const WireSnapshot& b) {
  return a.participants == b.participants && a.rest.effects == b.rest.effects &&
         a.rest.environment == b.rest.environment && a.rest.state_hash == b.rest.state_hash &&
         a.rest.driver_car.lateral_position_m == b.rest.driver_car.lateral_position_m;
}

}  // namespace

TEST_CASE("quantisation stays within its stated bounds") {
  Random random(1);
  const Snapshot snapshot = random_snapshot(random, 5, 500);
  const Snapshot received = from_wire(to_wire(snapshot));
  for (std::size_t i = 0; i < snapshot.participants.size(); ++i) {
    const auto& sent = snapshot.participants[i];
    const auto& got = received.participants[i];
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(std::abs(sent.world_from_vehicle.position_m[axis] - got.world_from_vehicle.position_m[axis]) <= 0.5 / 4096);
      CHECK(std::abs(sent.velocity_mps[axis] - got.velocity_mps[axis]) <= 0.5 / 1024);
    }
    CHECK(angle_between(sent.world_from_vehicle.orientation, got.world_from_vehicle.orientation) < 4e-6);
  }
}

TEST_CASE("the head travels exactly and only while it is not at rest") {
  Random random(3);
  Snapshot snapshot = random_snapshot(random, 5, 2);
  Bytes at_rest, moved;
  encode_snapshot(to_wire(snapshot), nullptr, at_rest);
  snapshot.driver_car.head = {{0.1, -0.25, 0.05}, -0.9};
  encode_snapshot(to_wire(snapshot), nullptr, moved);
  CHECK(moved.size() == at_rest.size() + 4 * sizeof(double));
  const auto decoded = decode_snapshot(moved, nullptr);
  REQUIRE(decoded);
  CHECK(decoded->rest.driver_car.head == snapshot.driver_car.head);
  CHECK(decode_snapshot(at_rest, nullptr)->rest.driver_car.head == Head{});
  // No screen gets a head position outside the possible.
  for (const Head& nowhere :
       {Head{{1.5, 0, 0}, 0.0}, Head{{0, 0, -1e300}, 0.0}, Head{{0, std::nan(""), 0}, 0.0}, Head{{}, 4.0}}) {
    snapshot.driver_car.head = nowhere;
    Bytes bytes;
    encode_snapshot(to_wire(snapshot), nullptr, bytes);
    CHECK_FALSE(decode_snapshot(bytes, nullptr));
  }
}

TEST_CASE("a gear or a lane that no car can have comes as the nearest that one can") {
  Random random(4);
  const auto sent = [&](std::int8_t gear, std::int32_t lane) {
    Snapshot snapshot = random_snapshot(random, 5, 2);
    snapshot.driver_car.gear = gear;
    snapshot.driver_car.lane = lane;
    Bytes bytes;
    encode_snapshot(to_wire(snapshot), nullptr, bytes);
    const auto decoded = decode_snapshot(bytes, nullptr);
    REQUIRE(decoded.has_value());
    return std::pair(int{decoded->rest.driver_car.gear}, decoded->rest.driver_car.lane);
  };
  CHECK(sent(-1, -1000) == std::pair(-1, -1000));
  CHECK(sent(20, 1000) == std::pair(20, 1000));
  CHECK(sent(-2, -1001) == std::pair(-1, -1000));
  CHECK(sent(21, 1001) == std::pair(20, 1000));
}

TEST_CASE("a keyframe and a difference decode to exactly what was encoded") {
  Random random(2);
  Snapshot first = random_snapshot(random, 10, 100);
  first.effects = {{7, 1, Bytes(20, std::byte{3}), 10}, {9, 2, Bytes(5, std::byte{4}), 12}};
  Snapshot second = random_snapshot(random, 12, 120);
  second.participants.erase(second.participants.begin() + 5, second.participants.begin() + 9);
  second.effects = {{9, 2, Bytes(6, std::byte{4}), 0}, {11, 1, Bytes(2, std::byte{1}), 12 + max_effect_lead_ticks}};
  const WireSnapshot wire_first = to_wire(first), wire_second = to_wire(second);

  Bytes keyframe, difference;
  encode_snapshot(wire_first, nullptr, keyframe);
  encode_snapshot(wire_second, &wire_first, difference);
  const auto decoded_first = decode_snapshot(keyframe, nullptr);
  REQUIRE(decoded_first);
  CHECK(same(*decoded_first, wire_first));
  REQUIRE(read_snapshot_header(difference));
  CHECK(read_snapshot_header(difference)->baseline == Tick{10});
  const auto decoded_second = decode_snapshot(difference, &*decoded_first);
  REQUIRE(decoded_second);
  CHECK(same(*decoded_second, wire_second));
}

TEST_CASE("an effect whose keyframe stays costs no byte and whoever has no baseline gets it whole") {
  Random random(6);
  Snapshot without = random_snapshot(random, 10, 1), with = without;
  with.effects = {{7, 1, Bytes(5000, std::byte{3}), 4}, {9, 2, Bytes(300, std::byte{4}), 12}};
  Snapshot later_without = without, later_with = with;
  later_without.tick = later_with.tick = 11;
  Bytes plain, resting, keyframe;
  const WireSnapshot before = to_wire(without), before_with = to_wire(with);
  encode_snapshot(to_wire(later_without), &before, plain);
  encode_snapshot(to_wire(later_with), &before_with, resting);
  encode_snapshot(to_wire(later_with), nullptr, keyframe);
  CHECK(resting.size() == plain.size());
  const auto joined = decode_snapshot(keyframe, nullptr);
  REQUIRE(joined);
  CHECK(joined->rest.effects == later_with.effects);
}

TEST_CASE("a difference refuses a baseline it was not made against") {
  Random random(3);
  const WireSnapshot a = to_wire(random_snapshot(random, 10, 3)), b = to_wire(random_snapshot(random, 11, 3)),
                     c = to_wire(random_snapshot(random, 12, 3));
  Bytes difference;
  encode_snapshot(c, &a, difference);
  CHECK_FALSE(decode_snapshot(difference, &b));
  CHECK_FALSE(decode_snapshot(difference, nullptr));
}

TEST_CASE("vehicles that keep their acceleration cost almost nothing") {
  Random random(4);
  Snapshot first = random_snapshot(random, 10, 200);
  const WireSnapshot wire_first = to_wire(first);
  Snapshot second = from_wire(wire_first);
  second.tick = 11;
  second.simulated_time_s += 1.0 / 120.0;
  for (auto& p : second.participants) {
    p.world_from_vehicle.position_m += p.velocity_mps / 120.0 + 0.5 * p.acceleration_mps2 / 14400.0;
    p.velocity_mps += p.acceleration_mps2 / 120.0;
    p.wheel_spin_rad += p.wheel_spin_radps / 120.0;
  }
  Bytes keyframe, difference;
  encode_snapshot(wire_first, nullptr, keyframe);
  encode_snapshot(to_wire(second), &wire_first, difference);
  MESSAGE("200 vehicles: keyframe " << keyframe.size() << " bytes, difference " << difference.size() << " bytes");
  CHECK(difference.size() < keyframe.size() / 5);
}

TEST_CASE("truncated and mutated bytes are refused or decode within bounds") {
  Random random(5);
  const WireSnapshot first = to_wire(random_snapshot(random, 10, 8)), second = to_wire(random_snapshot(random, 11, 9));
  Bytes difference;
  encode_snapshot(second, &first, difference);
  for (std::size_t length = 0; length < difference.size(); ++length)
    CHECK_FALSE(decode_snapshot(std::span(difference).first(length), &first));
  int accepted = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Bytes mutated = difference;
    for (int k = 0; k < 3; ++k) mutated[random.below(mutated.size())] = static_cast<std::byte>(random.below(256));
    const auto decoded = decode_snapshot(mutated, &first);
    if (!decoded) continue;
    ++accepted;
    const Snapshot snapshot = from_wire(*decoded);
    for (const auto& p : snapshot.participants) {
      REQUIRE(p.model < vehicle_models().size());
      REQUIRE(std::abs(p.world_from_vehicle.position_m.x) <= 524288.0);
      REQUIRE(std::isfinite(p.world_from_vehicle.orientation.w));
    }
  }
  CHECK(accepted > 0);
}

TEST_CASE("a wheel's angle comes back as the part of a turn that it is however often it has turned") {
  for (const double turns : {0.3, 1.3, 5.3, -0.7, -2.7}) {
    CAPTURE(turns);
    Participant participant;
    participant.wheel_spin_rad = turns * 2.0 * glm::pi<double>();
    WireParticipant wire;
    quantise(participant, wire);
    CHECK(wire.fields[field_wheel_spin] >= participant_field_limits(field_wheel_spin).low);
    CHECK(wire.fields[field_wheel_spin] <= participant_field_limits(field_wheel_spin).high);
    CHECK(std::abs(dequantise(wire).wheel_spin_rad - 0.6 * glm::pi<double>()) < 1e-4);
  }
}

}  // namespace septet

// Snapshots in the session file: lossless, smaller than on the wire, and safe on any bytes.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "engine/world/vehicle_model.hpp"
#include "logging/session/packed_snapshot.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

bool are_equal(const WireSnapshot& a, const WireSnapshot& b) {
  Bytes left, right;
  encode_snapshot(a, nullptr, left);
  encode_snapshot(b, nullptr, right);
  return left == right;
}

/// Vehicles of many models in a bend, entering and leaving; one of them spins, so that every component of its orientation is the
/// largest in turn.
WireSnapshot bend(Tick tick) {
  Snapshot snapshot = drive_snapshot(tick, 40);
  std::erase_if(snapshot.participants,
                [&](const Participant& who) { return who.id % 7 == 3 && (tick / 5) % 3 == who.id % 3; });
  for (Participant& who : snapshot.participants) {
    who.model = static_cast<ModelIndex>(who.id % vehicle_models().size());
    who.paint = static_cast<std::uint8_t>(who.id % 5);
    who.lamps.bits = static_cast<std::uint16_t>((who.id + tick / 20) % 4);
  }
  Participant& spinning = snapshot.participants[1];
  const double turn = 0.4 * static_cast<double>(tick);
  spinning.world_from_vehicle.orientation = orientation_from_angles(turn, 0.7 * turn, 1.3 * turn);
  spinning.world_from_vehicle.position_m.z = tick % 2 == 0 ? 4e5 : -4e5;
  spinning.wheel_spin_rad = 6.2;
  spinning.wheel_lift_m = {0.1, -0.2, 0.3, static_cast<double>(tick % 3)};
  return to_wire(snapshot);
}

std::vector<Bytes> pack_all(const std::vector<WireSnapshot>& wires, std::size_t keyframe_every) {
  SnapshotPacker packer;
  std::vector<Bytes> rows;
  for (std::size_t i = 0; i < wires.size(); ++i)
    packer.pack(wires[i], i % keyframe_every == 0 ? nullptr : &wires[i - 1], rows.emplace_back());
  return rows;
}

}  // namespace

TEST_CASE("packed snapshots come back to the last bit, keyframes and differences, whoever comes and goes") {
  std::vector<WireSnapshot> wires;
  for (Tick tick = 0; tick < 60; ++tick) wires.push_back(bend(tick));
  wires.push_back(to_wire(Snapshot{.tick = 60, .simulated_time_s = 0.5}));  // All have left…
  wires.push_back(bend(61));                                                // …and everybody is new.
  const auto rows = pack_all(wires, 25);
  SnapshotUnpacker unpacker;
  std::optional<WireSnapshot> before;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto header = read_stored_header(rows[i]);
    REQUIRE(header.has_value());
    CHECK(header->tick == wires[i].rest.tick);
    CHECK(header->baseline.has_value() == (i % 25 != 0));
    auto wire = unpacker.unpack(rows[i], header->baseline ? &*before : nullptr);
    REQUIRE_MESSAGE(wire.has_value(), (wire ? "" : wire.error().what));
    REQUIRE(are_equal(*wire, wires[i]));
    before = std::move(*wire);
  }
}

TEST_CASE("a keyframe is read without what lies before it") {
  std::vector<WireSnapshot> wires;
  for (Tick tick = 0; tick < 30; ++tick) wires.push_back(bend(tick));
  const auto rows = pack_all(wires, 10);
  SnapshotUnpacker unpacker;
  REQUIRE(unpacker.unpack(rows[10], nullptr).has_value());
  const auto next = unpacker.unpack(rows[11], &wires[10]);
  REQUIRE(next.has_value());
  CHECK(are_equal(*next, wires[11]));
}

TEST_CASE("traffic in a bend takes less than half of what the wire needs") {
  std::size_t packed = 0, on_wire = 0;
  std::vector<WireSnapshot> wires;
  for (Tick tick = 0; tick < 60; ++tick) wires.push_back(to_wire(drive_snapshot(tick, 200)));
  for (const Bytes& row : pack_all(wires, 120)) packed += row.size();
  for (std::size_t i = 1; i < wires.size(); ++i) {
    Bytes bytes;
    encode_snapshot(wires[i], &wires[i - 1], bytes);
    on_wire += bytes.size();
  }
  CAPTURE(packed);
  CAPTURE(on_wire);
  CHECK(2 * packed < on_wire);
}

TEST_CASE("a row of an earlier build is read as it lies") {
  Bytes raw;
  encode_snapshot(bend(5), nullptr, raw);
  const auto header = read_stored_header(raw);
  REQUIRE(header.has_value());
  CHECK(header->tick == 5);
  SnapshotUnpacker unpacker;
  const auto wire = unpacker.unpack(raw, nullptr);
  REQUIRE(wire.has_value());
  CHECK(are_equal(*wire, bend(5)));
}

TEST_CASE("altered, cut and stretched rows are refused or are snapshots, and nothing else") {
  const WireSnapshot first = bend(0);
  const auto rows = pack_all({first, bend(1)}, 5);
  Random random(11);
  int refused = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    Bytes bytes = rows[1];
    const auto at = static_cast<std::size_t>(random.below(bytes.size()));
    switch (random.below(3)) {
      case 0:
        bytes[at] ^= static_cast<std::byte>(1 + random.below(255));
        break;
      case 1:
        bytes.resize(at);
        break;
      default:
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), std::byte{0xff});
        break;
    }
    (void)read_stored_header(bytes);
    SnapshotUnpacker unpacker;
    REQUIRE(unpacker.unpack(rows[0], nullptr).has_value());
    const auto wire = unpacker.unpack(bytes, &first);
    refused += !wire;
    if (!wire) continue;
    Bytes again;
    encode_snapshot(*wire, nullptr, again);
    CHECK(decode_snapshot(again, nullptr).has_value());
  }
  CHECK(refused > 600);
}

}  // namespace septet::logging

#pragma once
/// The snapshot in the integers that travel: one codec for the tick lane and the session log.
///
/// `to_wire` quantises, `encode_snapshot` writes the difference to a baseline (or a keyframe), `decode_snapshot` reads
/// it back, `from_wire` gives every receiver's snapshot. Quantisation happens once, on the server, so that all screens,
/// the log and the server's own record of sent ticks agree to the bit.
///
/// Bounds of the quantisation (half a step): position 0.13 mm (world within ±524 km), velocity 0.5 mm/s, acceleration 2
/// mm/s², orientation 2 µrad, angular velocity 31 µrad/s, steering 31 µrad, wheel lift 0.13 mm. The format is in
/// engine/world/SNAPSHOT.md. Bytes come from outside: a decoder refuses values out of bounds and never checks.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/snapshot.hpp"

namespace septet {

inline constexpr std::size_t max_wire_participants = 4096;
inline constexpr std::size_t max_wire_effects = 4096;
inline constexpr std::size_t max_wire_effect_bytes = 1 << 20;  ///< Bound on all effects of one snapshot together.
inline constexpr Tick max_effect_lead_ticks = 64;  ///< Limit on the lead of an effect's keyframe over its snapshot.

/// Field order of a participant on the wire; SNAPSHOT.md gives each one's unit.
enum ParticipantField : std::size_t {
  field_model,
  field_paint,
  field_lamps,
  field_position_x,
  field_position_y,
  field_position_z,
  field_largest,
  field_orientation_a,
  field_orientation_b,
  field_orientation_c,
  field_velocity_x,
  field_velocity_y,
  field_velocity_z,
  field_acceleration_x,
  field_acceleration_y,
  field_acceleration_z,
  field_angular_velocity_x,
  field_angular_velocity_y,
  field_angular_velocity_z,
  field_front_steer,
  field_wheel_spin,
  field_wheel_spin_rate,
  field_lift_front_left,
  field_lift_front_right,
  field_lift_rear_left,
  field_lift_rear_right,
  participant_field_count
};

struct WireParticipant {
  ParticipantId id = 0;
  std::array<std::int32_t, participant_field_count> fields{};
  bool operator==(const WireParticipant&) const = default;
};

/// A snapshot whose participants are quantised; the rest travels exactly.
struct WireSnapshot {
  Snapshot rest;                              ///< Everything but the participants, whose list is empty.
  std::vector<WireParticipant> participants;  ///< Ascending id.
};

/// Seconds by which a receiver moves the baseline's participants on, for an instant at `time_s`; 1 at most, 0 for one
/// before it.
double seconds_since(const WireSnapshot& baseline, double time_s);

/// `old` is a spare one: its memory is reused.
WireSnapshot to_wire(const Snapshot& snapshot, WireSnapshot old = {});
Snapshot from_wire(const WireSnapshot& wire);

/// Appends the bytes of `wire`, as a difference to `baseline` or, where that is null, as a keyframe.
void encode_snapshot(const WireSnapshot& wire, const WireSnapshot* baseline, Bytes& out);
/// The same for callers that send the participants in another way: none has changed, so that decoding gives the
/// baseline's, moved on.
void encode_without_participants(const WireSnapshot& wire, const WireSnapshot* baseline, Bytes& out);

struct SnapshotHeader {
  Tick tick = 0;
  std::optional<Tick> baseline;  ///< The tick that the difference refers to; empty for a keyframe.
};

/// Reads only the header, so that the caller can find the baseline.
Expected<SnapshotHeader> read_snapshot_header(std::span<const std::byte> bytes);

/// Decodes one snapshot; `baseline` must be the one named by the header. Refuses malformed or out-of-bounds bytes.
Expected<WireSnapshot> decode_snapshot(std::span<const std::byte> bytes, const WireSnapshot* baseline);

}  // namespace septet

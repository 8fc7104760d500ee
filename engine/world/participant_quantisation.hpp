#pragma once
/// One participant to the integers of the wire and back, and its expected state some time later.

#include <cstdint>

#include "engine/world/wire_snapshot.hpp"

namespace septet {

/// Closed range of a field; a decoder refuses a value outside it.
struct FieldLimits {
  std::int32_t low = 0, high = 0;
};
const FieldLimits& participant_field_limits(std::size_t field);

/// Writes every field of `wire`.
void quantise(const Participant& participant, WireParticipant& wire);
Participant dequantise(const WireParticipant& wire);

/// The baseline moved on by its own velocity, acceleration and wheel speed: the reference of a difference, because most
/// vehicles continue their motion. Same integers on every machine: one rounding of a plain product per field.
WireParticipant extrapolate(const WireParticipant& wire, double seconds);

}  // namespace septet

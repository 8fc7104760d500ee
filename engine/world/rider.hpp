#pragma once
/// Numbers of riders: who leaves a two-wheeler in a crash is a participant of his own from then on.

#include "engine/world/snapshot.hpp"

namespace septet {

/// Rider of the machine with number n: this and n.
inline constexpr ParticipantId first_rider_participant = 8192;

constexpr ParticipantId rider_of(ParticipantId machine) { return first_rider_participant + machine; }

}  // namespace septet

#pragma once
/// Numbers of riders: who leaves a two-wheeler in a crash is a participant of his own from then on.

#include "engine/world/snapshot.hpp"

namespace septet {

/// Rider of the machine with number n: this and n.
inline constexpr ParticipantId first_rider_participant = 8192;

constexpr ParticipantId rider_of(ParticipantId machine) { return first_rider_participant + machine; }

/// The machine of a rider's number; any other number is its own.
constexpr ParticipantId machine_of(ParticipantId number) {
  return number >= first_rider_participant && number < 2 * first_rider_participant ? number - first_rider_participant
                                                                                   : number;
}

/// The person whom a number means: the rider who has left this machine, else the participant; null: neither is there.
inline const Participant* find_person(const Snapshot& world, ParticipantId number) {
  const Participant* rider = find_participant(world, rider_of(number));
  return rider ? rider : find_participant(world, number);
}

}  // namespace septet

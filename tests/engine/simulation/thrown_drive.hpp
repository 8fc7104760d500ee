#pragma once
/// What tests of people who are thrown have in common.

#include <doctest/doctest.h>

#include "engine/world/driver_input.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

inline DriverInput braking() {
  DriverInput input;
  input.brake = 0.8;
  return input;
}

inline const Participant& shown(const Snapshot& snapshot, ParticipantId number) {
  const Participant* found = find_participant(snapshot, number);
  REQUIRE(found != nullptr);
  return *found;
}

}  // namespace septet::simulation

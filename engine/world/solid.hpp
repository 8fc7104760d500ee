#pragma once
/// Numbers of participants that are solids: boxes that stand fast in the place of things that an editor has put into
/// the scene. The scene draws the things; as participants they are met, seen by drivers and logged, and never drawn.

#include <cstdint>

#include "engine/world/snapshot.hpp"

namespace septet {

inline constexpr std::uint32_t most_solids = 64;
/// Above the numbers of all who drive, walk or ride.
inline constexpr ParticipantId first_solid_participant = 32768;

constexpr bool is_solid(ParticipantId id) {
  return id >= first_solid_participant && id - first_solid_participant < most_solids;
}

}  // namespace septet

#pragma once
/// People and two-wheelers that were thrown. The stage that begins and advances them: thrown_stage.hpp.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/physics/person/jointed_body.hpp"
#include "engine/road/road_position.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

struct ThrownBody {
  ParticipantId id = 0;
  ModelIndex model = 0;  ///< What it is drawn as from now on: a machine without its rider.
  std::uint8_t paint = 0;
  person::JointedBody body;
  std::optional<road::RoadPosition> road;  ///< Last place, where the next search for the ground begins.
  std::vector<ParticipantId> met;          ///< Vehicles that have met whose body it is, ascending: each is told once.
};

}  // namespace septet::simulation

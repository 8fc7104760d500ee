#pragma once
/// The members of thrown bodies, for engine/core/archive.hpp, and what must hold of those that were read.

#include <algorithm>
#include <vector>

#include "engine/physics/impact/sound_state.hpp"
#include "engine/road/position_members.hpp"
#include "engine/simulation/thrown_state.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::person {
SEPTET_MEMBERS(PointMass, position_m, velocity_mps)
SEPTET_MEMBERS(JointedBody, kind, mass_kg, masses, still_ticks)
}  // namespace septet::person

namespace septet::simulation {

SEPTET_MEMBERS(ThrownBody, id, model, paint, body, road, met)

inline void require_sound(StateReader& reader, const road::RoadNetwork& roads, const std::vector<ThrownBody>& thrown) {
  constexpr auto wrong = "thrown bodies do not fit together";
  reader.require(std::ranges::is_sorted(thrown, std::ranges::less_equal{}, &ThrownBody::id), wrong);
  for (const ThrownBody& each : thrown) {
    reader.require(each.model < vehicle_models().size() && each.body.kind <= person::BodyKind::motorcycle &&
                       impact::is_positive(each.body.mass_kg),
                   wrong);
    reader.require(std::ranges::is_sorted(each.met, std::ranges::less_equal{}), wrong);
    if (each.road) road::require_on_roads(reader, roads, *each.road);
  }
}

}  // namespace septet::simulation

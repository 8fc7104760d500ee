#pragma once
/// Fires of one drive: burning vehicles, the grid of air in which their smoke moves, and the smoke's keyframes.
///
/// The first fire places the grid: in a tunnel it is a stretch of its tube with the tube's own walls, along the road's
/// curve; elsewhere a piece of open air. Vehicles are obstacles, the wind blows through. One smoke for the whole drive:
/// a fire outside the grid gives flames without smoke that is worth following, and is left out.

#include <optional>
#include <vector>

#include "engine/effects/smoke/smoke_keyframe.hpp"
#include "engine/effects/smoke/smoke_state.hpp"
#include "engine/effects/smoke/soot_keyframe.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

struct Fire {
  ParticipantId vehicle = 0;
  std::size_t flames = 0, smoke = 0;  ///< Indices of its emitters.
  double burning_s = 0.0;
  bool burning = true;
};

struct FireState {
  std::optional<smoke::State> smoke;  ///< Empty before the first fire.
  smoke::KeyframeTrack track;
  EffectKeyframe soot;  ///< Soot on the walls; empty before there is any.
  std::vector<Fire> fires;
  std::vector<EffectKeyframe> keyframes;  ///< Ascending id, as the snapshot carries them.
};

/// The air around a place: see above.
smoke::Grid grid_around(const road::RoadNetwork& roads, const RigidTransform& world_from_vehicle);

/// Sets a vehicle on fire; a burning one is left as it is.
void ignite(const road::RoadNetwork& roads, const Participant& vehicle, std::uint64_t seed, FireState& state);
void extinguish(ParticipantId vehicle, FireState& state);

/// Advances by one step to the instant `time_s`, which is that of `tick`. `participants` ascending by id.
void advance_fires(const std::vector<Participant>& participants, const Environment& environment, Tick tick,
                   double time_s, double step_s, FireState& state);

}  // namespace septet::simulation

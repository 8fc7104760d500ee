#pragma once
/// State of a drive's effects, and their view of the world. The stage that advances it: effects_stage.hpp.

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/obstacles.hpp"
#include "engine/simulation/effects/crashes.hpp"
#include "engine/simulation/effects/dents.hpp"
#include "engine/simulation/effects/fire_stage.hpp"
#include "engine/simulation/effects/ice_stage.hpp"
#include "engine/simulation/effects/keyframe_schedule.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

inline constexpr Tick effects_step_ticks = 2;
inline constexpr std::size_t most_pieces = 96;   ///< Beyond that, the piece furthest from the driver is removed first.
inline constexpr double debris_reach_m = 600.0;  ///< Debris further from the driver is removed.

struct EffectsState {
  debris::State debris;
  CrashMemory crashes;
  DentState dents;
  FireState fires;
  IceState ice;
  Random random{0};
  PublishedEffects published;
  /// Hash of all steps so far, chained: two drives that ever differed in their effects differ in it.
  std::uint64_t hash = 0;
  /// The road's surface as one plane per square metre near debris: a cache, not state.
  std::unordered_map<std::uint64_t, debris::GroundPoint> surface_memory;
  std::optional<road::RoadPosition> surface_hint;
};

/// The stage's view of the world.
struct EffectsWorld {
  const road::RoadNetwork& roads;
  const roadside::Obstacles* obstacles = nullptr;  ///< Obstacles beside the roads; null: there are none.
  const std::vector<Participant>& participants;    ///< Ascending id, as they are at `tick`.
  const Environment& environment;
  ParticipantId driver = 0;
  double ground_friction = 1.0;  ///< Multiplies a material's friction on the road: less than 1 on ice and snow.
  Tick tick = 0;                 ///< A multiple of effects_step_ticks.
  double tick_s = 0.0;
  std::span<const std::uint32_t> gone{};  ///< Of the obstacles those that are left out, ascending.
};

}  // namespace septet::simulation

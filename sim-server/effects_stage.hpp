#pragma once
/// The effects of one drive: debris of what broke, and (with engine/effects/smoke) what burns, as a stage of the tick.
///
///     crash or storyboard → requests → advance_effects → keyframes → snapshot
///
/// Debris is stepped every second tick (16.7 ms, what its implicit step wants) and is then one step ahead of the rest: at
/// tick n it stands as it will at n + 2, met by vehicles that go on with their velocity. So a screen, which shows the past,
/// always has a keyframe on either side of what it shows. World frame; free of files and clocks; the same model, seed and
/// inputs give the same hash.

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/effects/debris/debris_state.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/obstacles.hpp"
#include "engine/scenario/scenario.hpp"
#include "engine/scenario/scenario_state.hpp"
#include "engine/world/snapshot.hpp"
#include "sim-server/crashes.hpp"
#include "sim-server/fire_stage.hpp"
#include "sim-server/keyframe_schedule.hpp"

namespace septet::server {

inline constexpr Tick effects_step_ticks = 2;
inline constexpr std::size_t most_pieces = 96;   ///< What lies furthest from the driver goes first.
inline constexpr double debris_reach_m = 600.0;  ///< Debris further from the driver is gone.

struct EffectsState {
  debris::State debris;
  CrashMemory crashes;
  FireState fires;
  Random random{0};
  PublishedEffects published;
  std::uint64_t hash = 0;  ///< Of all steps so far, chained: two drives that ever differed in their effects differ in it.
  /// The road's surface as one plane per square metre where debris has been: a memory, and no state.
  std::unordered_map<std::uint64_t, debris::GroundPoint> surface_memory;
  std::optional<road::RoadPosition> surface_hint;
};

/// What the stage sees of the world.
struct EffectsWorld {
  const road::RoadNetwork& roads;
  const roadside::Obstacles* obstacles = nullptr;  ///< What stands beside the roads; none without.
  const std::vector<Participant>& participants;  ///< Ascending id, as they are at `tick`.
  const Environment& environment;
  ParticipantId driver = 0;
  double ground_friction = 1.0;  ///< Multiplies a material's friction on the road: less than 1 on ice and snow.
  Tick tick = 0;                 ///< A multiple of effects_step_ticks.
  double tick_s = 0.0;
};

struct EffectsReport {
  int fractures = 0;
  CrashOutcome crashes;
  int bad_numbers = 0;
  Vec3 impulse_on_driver_ns{0.0};  ///< What debris and crashes gave to the driver's car.
  PublishReport published;
};

/// Objects of the scenario that can be hit: those whose type is a part's name (part_of_name) stand on their feet, asleep.
EffectsState initial_effects(const scenario::Scenario& scenario, const scenario::ScenarioState& storyboard, std::uint64_t seed);

/// "bumper", "door", "lamp", "windscreen", "traffic-cone", "barrier-post", "ice-slab".
std::optional<debris::Part> part_of_name(std::string_view name);

/// Puts a part on the roof of a vehicle: see scenario::EffectAction.
void spill(const scenario::EffectAction& action, const scenario::Entity& entity, const scenario::EntityState& from,
           EffectsState& state);

/// Nothing would change: the stage may be skipped.
bool effects_are_still(const EffectsState& state);

/// All keyframes as a snapshot carries them, ascending id.
std::vector<EffectKeyframe> effect_keyframes(const EffectsState& state);

/// Lamps that were torn off shine no more.
void show_damage(const EffectsState& state, std::vector<Participant>& participants);

EffectsReport advance_effects(const EffectsWorld& world, EffectsState& state);

/// How high debris stands under a wheel over the road's surface there, and what is thick enough to matter; at most what a
/// tyre climbs.
double obstacle_height_m(const EffectsState& state, const Vec3& surface_point_m);

}  // namespace septet::server

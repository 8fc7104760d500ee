#pragma once
/// The effects of one drive: debris of crashes, and (with engine/effects/smoke) fires, as a stage of the tick.
///
///     crash or storyboard → requests → advance_effects → keyframes → snapshot
///
/// Debris is stepped every second tick (16.7 ms, as its implicit step requires) and is then one step ahead of the rest:
/// at tick n it stands as it will at n + 2, met by vehicles that go on with their velocity. So a screen, which shows
/// the past, always has a keyframe on either side of the shown instant. World frame; free of files and clocks; the same
/// model, seed and inputs give the same hash.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/scenario/model/scenario.hpp"
#include "engine/scenario/run/scenario_state.hpp"
#include "engine/simulation/effects/effects_state.hpp"

namespace septet::simulation {

struct EffectsReport {
  int fractures = 0;
  CrashOutcome crashes;
  int bad_numbers = 0;
  Vec3 impulse_on_driver_ns{0.0};  ///< Impulse of debris and crashes on the driver's car.
  PublishReport published;
};

/// Takes in objects of the scenario that can be hit: those whose type is a part's name (part_of_name) stand on their
/// feet, asleep.
EffectsState initial_effects(const scenario::Scenario& scenario, const scenario::ScenarioState& storyboard,
                             std::uint64_t seed);

/// One of breakable_names.
std::optional<debris::Part> part_of_name(std::string_view name);

/// The names of all parts, as users write them.
std::span<const std::string_view> part_names();
/// Stands a part on its feet, at rest: `feet` is its contact with the ground.
void stand_part(debris::Part part, const RigidTransform& feet, EffectsState& state);

/// A standing or lying piece: placed, spilt, or broken off.
struct LyingPiece {
  std::uint32_t id = 0;   ///< Never reused in a drive.
  std::string_view part;  ///< One of part_names().
  Vec3 position_m{0.0};   ///< World, somewhere on it.
};
std::vector<LyingPiece> lying_pieces(const EffectsState& state);  ///< Ascending id.
/// Call between two ticks. False: there is no such piece any more.
bool remove_piece(std::uint32_t id, EffectsState& state);

/// Puts a part on the roof of a vehicle, which is `vehicle` among the participants: see scenario::EffectAction. A slab
/// of ice comes with the thickness that has not melted.
void spill(const scenario::EffectAction& action, const scenario::Entity& entity, const scenario::EntityState& from,
           ParticipantId vehicle, EffectsState& state);

/// True where a step would change nothing: the stage may be skipped.
bool effects_are_still(const EffectsState& state);

/// All keyframes as a snapshot carries them, ascending id.
std::vector<EffectKeyframe> effect_keyframes(const EffectsState& state);

/// Switches off lamps that were torn off.
void show_damage(const EffectsState& state, std::vector<Participant>& participants);

EffectsReport advance_effects(const EffectsWorld& world, EffectsState& state);

/// Height of debris under a wheel over the road's surface there, if thick enough to matter; at most the height that a
/// tyre climbs.
double obstacle_height_m(const EffectsState& state, const Vec3& surface_point_m);

}  // namespace septet::simulation

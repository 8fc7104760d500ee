#pragma once
/// Debris of a crash of two bodies.
///
/// The impact itself is over within about a tenth of a second, so it is computed at once. Both bodies crush like
/// springs that do not return (Huang 2002, Vehicle Crash Mechanics, ch. 4): with V the closing speed and ω the
/// frequency of the crush, the speed that body k loses is ΔV_k (1 − cos ωt), its deceleration ΔV_k ω sin ωt, its crush
/// ΔV_k/ω.
/// - A part within the crush of the contact is struck at the closing speed: it breaks where its material cannot bear
///   that, and its fragments are squeezed out sideways and upwards. A laminated windscreen cracks and stays in its
///   frame; a tempered side window crumbles, also when its door is broken off.
/// - Any other part is held by its mounts until its mass times the deceleration passes their strength; from then on it
///   flies with the speed that the body had at that instant.
///
/// Mass is kept. The momentum of parts that fly off differs from their momentum on the body by impulses that are
/// returned in CrashBody::impulse_ns. No part gains energy.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/mounted_part.hpp"

namespace septet::debris {

struct CrashBody {
  Box box;                            ///< With its motion before the impact.
  double mass_kg = INFINITY;          ///< Infinite: immovable, as a barrier.
  std::vector<MountedPart> parts;     ///< In: its mounted parts. Out: those that have not broken off.
  std::optional<PieceOrigin> origin;  ///< Vehicle, model and paint of its parts; empty: of no vehicle.
  Vec3 impulse_ns{0.0};               ///< Out: impulse on it of the parts that broke off.
  Mounts torn = 0;                    ///< Out: whose parts broke off.
};

struct Crash {
  Vec3 point_m{0.0};       ///< Middle of the contact, world frame.
  Vec3 normal{1.0, 0, 0};  ///< Unit length, from the second body to the first.
  CrashBody first, second;
};

struct CrashReport {
  double closing_speed_mps = 0.0;     ///< Along the normal.
  int struck = 0, torn_off = 0;       ///< Parts broken loose by the contact, and by their inertia.
  int starred = 0;                    ///< Laminated panes that cracked and stayed.
  int fragments = 0;                  ///< Pieces of broken-off parts, shards included.
  double kinetic_j = 0.0;             ///< Of all of these as they fly off.
  std::vector<std::uint32_t> pieces;  ///< Ids of those that are now in the state's pieces.
};

/// Closing speed below which nothing breaks off.
inline constexpr double least_crash_speed_mps = 3.0;

/// Breaks parts off and adds them to the state; `world` has the ground and the boxes in which pieces must not start,
/// with or without the two bodies' own. Call once a crash, in the tick of the first contact.
CrashReport crash(State& state, Crash& crash, const ContactWorld& world, Random& random);

}  // namespace septet::debris

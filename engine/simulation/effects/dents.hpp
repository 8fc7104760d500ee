#pragma once
/// Where and how deep the crashes of a drive dent who takes part in them (engine/effects/debris/dent.hpp), and the keyframe that
/// tells everybody. Nothing of it acts back on the drive.

#include <vector>

#include "engine/effects/debris/dent.hpp"
#include "engine/physics/vehicle/hull.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

struct DentState {
  std::vector<debris::DentedVehicle> vehicles;
  EffectKeyframe keyframe;  ///< No bytes before there are dents.
};

/// A dent that a crash made.
struct MadeDent {
  ParticipantId vehicle = 0;
  debris::Dent dent;
};

/// Of two vehicles that close at `closing_mps` along `normal` (level, of unit length, from the second to the first): nothing for
/// people and for who is on two wheels, nor where it is too slow to leave a dent.
std::vector<MadeDent> dents_of_crash(const Participant& first, const Participant& second, const Vec3& normal,
                                     double closing_mps);
/// Of a vehicle that meets what stands beside the road; nothing from what yields.
std::vector<MadeDent> dents_of_touch(const Participant& vehicle, const vehicle::HullTouch& touch);

/// Takes in what this step's crashes have made, and forgets who has left; the keyframe shows `shows`.
void advance_dents(const std::vector<MadeDent>& made, const std::vector<Participant>& participants, Tick shows,
                   DentState& state);

}  // namespace septet::simulation

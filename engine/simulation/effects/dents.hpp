#pragma once
/// Dents from the crashes of a drive, by place and depth (engine/effects/debris/dent.hpp), and the keyframe that shows
/// them. They have no effect on the drive.

#include <vector>

#include "engine/effects/debris/dent.hpp"
#include "engine/physics/vehicle/hull.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

struct DentState {
  std::vector<debris::DentedVehicle> vehicles;
  EffectKeyframe keyframe;  ///< Empty before there are dents.
};

/// A dent made by a crash.
struct MadeDent {
  ParticipantId vehicle = 0;
  debris::Dent dent;
};

/// What a crash tore off.
struct TornOff {
  ParticipantId vehicle = 0;
  debris::Mounts mounts = 0;
};

struct VehicleCrash;

/// Dents of two vehicles in a crash: none in people and two-wheelers, nor at speeds
/// too low to leave one.
std::vector<MadeDent> dents_of_crash(const Participant& first, const Participant& second, const VehicleCrash& struck);
/// Dents of a vehicle that meets an obstacle beside the road; none from a yielding one.
std::vector<MadeDent> dents_of_touch(const Participant& vehicle, const vehicle::HullTouch& touch);

/// Adds the dents of this step's crashes and what they tore off, and drops those of participants that have left; the
/// keyframe shows `shows`.
void advance_dents(const std::vector<MadeDent>& made, const std::vector<TornOff>& torn,
                   const std::vector<Participant>& participants, Tick shows, DentState& state);

}  // namespace septet::simulation

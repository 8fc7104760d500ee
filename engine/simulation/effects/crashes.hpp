#pragma once
/// Crashes for the effects: the pair in contact, the normal, and the parts broken off.
///
/// Vehicles are boxes. The first tick of a contact is the crash; broken-off parts are remembered, so that no car loses
/// the same bumper twice. The driver's car takes the impact of another vehicle here (a plastic one along the normal),
/// and that of obstacles beside the road in vehicle::advance_hull; all other participants are moved by traffic or by
/// the storyboard.

#include <map>
#include <vector>

#include "engine/effects/debris/crash.hpp"
#include "engine/physics/vehicle/hull.hpp"
#include "engine/simulation/effects/dents.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

/// Parts that each crashed vehicle still carries.
using MountedParts = std::map<ParticipantId, std::vector<debris::MountedPart>>;

struct CrashMemory {
  /// Vehicles met by the driver's car since the effects' last step, in order of contact: for the next step.
  std::vector<ParticipantId> struck_by_driver;
  std::vector<vehicle::HullTouch> struck_standing;  ///< Obstacles beside the road, likewise.
  MountedParts parts;
};

/// A windscreen shaken by a crash.
struct ShakenGlass {
  ParticipantId vehicle = 0;
  bool gone = false;    ///< Broken out of its car.
  double across = 0.5;  ///< Place of the impact: 0 at its right, 1 at its left.
  double closing_mps = 0.0;
};

struct CrashOutcome {
  int crashes = 0;
  int pieces = 0;
  Vec3 impulse_on_driver_ns{0.0};
  std::vector<ShakenGlass> glass;
  std::vector<MadeDent> dents;
};

/// Contact of two boxes as rectangles on the ground: overlap, place, and normal (shortest, from b to a).
struct BoxContact {
  Vec3 point_m{0.0};
  Vec3 normal{1.0, 0.0, 0.0};
  double depth_m = 0.0;
};
std::optional<BoxContact> contact_of(const debris::Box& a, const debris::Box& b);

double vehicle_mass_kg(const Participant& participant);

/// Computes the crashes of the driver's car that `memory` names.
CrashOutcome advance_crashes(const std::vector<Participant>& participants, ParticipantId driver,
                             const debris::ContactWorld& world, CrashMemory& memory, debris::State& debris,
                             Random& random);

}  // namespace septet::simulation

#pragma once
/// Crashes as the effects see them: who touched whom, along which normal, and what broke off.
///
/// Vehicles are boxes. The first tick of a contact is the crash; parts that broke off are remembered, so that no car loses
/// the same bumper twice. The driver's car takes the blow of another vehicle here (a plastic one along the normal), and that
/// of what stands beside the road in vehicle::advance_hull; everybody else is moved by traffic or by the storyboard.

#include <map>
#include <vector>

#include "engine/effects/debris/crash.hpp"
#include "engine/physics/vehicle/hull.hpp"
#include "engine/simulation/effects/dents.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

/// What each vehicle that has crashed still carries.
using MountedParts = std::map<ParticipantId, std::vector<debris::MountedPart>>;

struct CrashMemory {
  std::vector<ParticipantId> struck_by_driver;  ///< Since the effects' last step, as they were met: for the next one.
  std::vector<vehicle::HullTouch> struck_standing;  ///< Likewise, of what stands beside the road.
  MountedParts parts;
};

/// A windscreen that a crash shook.
struct ShakenGlass {
  ParticipantId vehicle = 0;
  bool gone = false;    ///< It is in its car no more.
  double across = 0.5;  ///< Where it was hit: 0 at its right, 1 at its left.
  double closing_mps = 0.0;
};

struct CrashOutcome {
  int crashes = 0;
  int pieces = 0;
  Vec3 impulse_on_driver_ns{0.0};
  std::vector<ShakenGlass> glass;
  std::vector<MadeDent> dents;
};

/// Two boxes as rectangles on the ground: do they overlap, and if so, where and which way out (shortest, from b to a)?
struct BoxContact {
  Vec3 point_m{0.0};
  Vec3 normal{1.0, 0.0, 0.0};
  double depth_m = 0.0;
};
std::optional<BoxContact> contact_of(const debris::Box& a, const debris::Box& b);

double vehicle_mass_kg(const Participant& participant);

/// Works out the crashes of the driver's car that `memory` names.
CrashOutcome advance_crashes(const std::vector<Participant>& participants, ParticipantId driver,
                             const debris::ContactWorld& world, CrashMemory& memory, debris::State& debris,
                             Random& random);

}  // namespace septet::simulation

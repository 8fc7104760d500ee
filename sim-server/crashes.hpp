#pragma once
/// Crashes as the effects see them: who touched whom, along which normal, and what broke off.
///
/// Vehicles are boxes. The first tick of a contact is the crash; parts that broke off are remembered, so that no car loses
/// the same bumper twice. The driver's car takes the blow (a plastic one along the normal); everybody else is moved by
/// traffic or by the storyboard.

#include <map>
#include <vector>

#include "engine/effects/debris/crash.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::server {

/// What each vehicle that has crashed still carries.
using MountedParts = std::map<ParticipantId, std::vector<debris::MountedPart>>;

struct CrashMemory {
  std::vector<ParticipantId> struck_by_driver;  ///< Since the effects' last step, as they were met: for the next one.
  MountedParts parts;
  double barrier_contact_s = 0.0;  ///< For how long the driver's car has been free of barriers; 0 while it touches one.
  bool at_barrier = false;
};

struct CrashOutcome {
  int crashes = 0;
  int pieces = 0;
  double barrier_closing_mps = 0.0;  ///< Of a crash into a barrier in this step; 0 without one.
  Vec3 impulse_on_driver_ns{0.0};
};

/// Two boxes as rectangles on the ground: do they overlap, and if so, where and which way out (shortest, from b to a)?
struct BoxContact {
  Vec3 point_m{0.0};
  Vec3 normal{1.0, 0.0, 0.0};
  double depth_m = 0.0;
};
std::optional<BoxContact> contact_of(const debris::Box& a, const debris::Box& b);

double vehicle_mass_kg(const Participant& participant);

/// Works out the crashes of the driver's car: with the vehicles that `memory` names, and with the barriers given.
CrashOutcome advance_crashes(const std::vector<Participant>& participants, ParticipantId driver,
                             const std::vector<debris::Box>& barriers, const debris::ContactWorld& world, double step_s,
                             CrashMemory& memory, debris::State& debris, Random& random);

}  // namespace septet::server

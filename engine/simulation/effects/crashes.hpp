#pragma once
/// Crashes for the effects: the pair in contact, the normal, and the parts broken off.
///
/// Vehicles are boxes. The first tick of a contact is the crash; broken-off parts are remembered, so that no car loses
/// the same bumper twice. Vehicles take their impacts in simulation/collisions, those with obstacles beside the road in
/// vehicle::advance_hull.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "engine/effects/debris/crash.hpp"
#include "engine/physics/vehicle/hull.hpp"
#include "engine/simulation/effects/dents.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

/// Parts that each crashed vehicle still carries.
using MountedParts = std::map<ParticipantId, std::vector<debris::MountedPart>>;

/// One of two in a crash, as it was at the touch.
struct CrashedVehicle {
  ParticipantId id = 0;
  double mass_kg = 0.0;
  Vec3 velocity_mps{0.0};  ///< At its origin, world frame.
  Vec3 angular_velocity_radps{0.0};
};

/// An impact of two vehicles as it was at the touch: world frame.
struct VehicleCrash {
  CrashedVehicle first, second;
  Vec3 point_m{0.0};
  Vec3 normal{1.0, 0.0, 0.0};      ///< Unit length, level, from the second to the first.
  double closing_speed_mps = 0.0;  ///< Along the normal, of the surfaces.
};

/// A vehicle's touch of an obstacle beside the road, as it began.
struct StandingCrash {
  ParticipantId vehicle = 0;
  vehicle::HullTouch touch;
};

struct CrashMemory {
  /// Crashes of two vehicles since the effects' last step, in order of contact: for the next step.
  std::vector<VehicleCrash> struck_vehicles;
  std::vector<StandingCrash> struck_standing;  ///< With obstacles beside the road, likewise.
  MountedParts parts;
};

/// A windscreen shaken by a crash.
struct ShakenGlass {
  ParticipantId vehicle = 0;
  bool gone = false;    ///< Broken out of its car.
  double across = 0.5;  ///< Place of the impact: 0 at its right, 1 at its left.
  double closing_mps = 0.0;
};

/// What the parts that a crash broke off take of two bodies.
struct BrokenOff {
  ParticipantId first = 0;
  std::optional<ParticipantId> second;  ///< Empty: what stands, of `run`.
  std::uint32_t run = 0;
  Vec3 on_first_ns{0.0}, on_second_ns{0.0};
  double kinetic_j = 0.0;  ///< Of the pieces as they fly off.
};

struct CrashOutcome {
  int crashes = 0;
  int pieces = 0;
  Vec3 impulse_on_driver_ns{0.0};     ///< Of parts that broke off.
  std::vector<BrokenOff> broken_off;  ///< One a crash, in their order.
  std::vector<ShakenGlass> glass;
  std::vector<MadeDent> dents;
  std::vector<TornOff> torn;
};

/// Contact of two boxes as outlines on the ground (impact::contact_of): overlap, place, and normal (from b to a).
struct BoxContact {
  Vec3 point_m{0.0};
  Vec3 normal{1.0, 0.0, 0.0};
  double depth_m = 0.0;
};
/// Middle of the heights that both boxes have.
double contact_height_m(const debris::Box& a, const debris::Box& b);
std::optional<BoxContact> contact_of(const debris::Box& a, const debris::Box& b);
bool overlap(const Participant& a, const Participant& b);

/// Computes the crashes that `memory` names.
CrashOutcome advance_crashes(const std::vector<Participant>& participants, ParticipantId driver,
                             const debris::ContactWorld& world, CrashMemory& memory, debris::State& debris,
                             Random& random);

}  // namespace septet::simulation

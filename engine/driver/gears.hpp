#pragma once
/// A manual gearbox: left foot on the clutch, right hand on the lever, by what the engine says.
///
/// The driver hears the engine and knows the car: up a gear beyond a speed that grows with the
/// accelerator, down below another, and the clutch down before the engine stalls. Driving off, the
/// clutch is let out through its bite as fast as the engine keeps its speed. A change of gear is:
/// accelerator up and clutch down, lever through neutral, clutch out with the accelerator.

#include <cstdint>

#include "engine/driver/driver_parameters.hpp"

namespace septet::driver {

enum class GearPhase : std::uint8_t {
  holding,    ///< Clutch down: standing, or rolling with the gear for the speed in.
  biting,     ///< Driving off with a slipping clutch.
  driving,    ///< Clutch up.
  pressing,   ///< Clutch on its way down.
  moving,     ///< Lever on its way.
  releasing,  ///< Clutch on its way up in the new gear.
};

struct GearState {
  GearPhase phase = GearPhase::holding;
  int lever = 1;        ///< The gear it is in; 0 on its way through neutral.
  int target = 1;       ///< Gear that the lever goes to.
  double clutch = 1.0;  ///< 1 down.
  double phase_s = 0.0;
  double driving_s = 0.0;  ///< Since the last change.
  bool started = false;    ///< Has looked at the gear that is in.
};

/// What eyes and ears tell.
struct GearSenses {
  double engine_radps = 0.0;
  double speed_mps = 0.0;
  int gear = 0;              ///< That is in, seen when the drive begins.
  double accelerator = 0.0;  ///< Where the right foot would like it.
  bool braking = false;
};

/// Moves foot and hand; returns the accelerator that the right foot gives meanwhile.
double advance_gears(GearState& state, const GearParameters& gears, const CarKnowledge& car, const GearSenses& senses,
                     double dt_s);

}  // namespace septet::driver

#pragma once
/// A manual gearbox: left foot on the clutch, right hand on the lever, guided by the engine's sound.
///
/// The driver hears the engine and knows the car: up a gear beyond a speed that grows with the accelerator, down below
/// another, and the clutch down before the engine stalls. Driving off, the clutch is let out through its bite as fast
/// as the engine keeps its speed. A change of gear is: accelerator up and clutch down, lever through neutral, clutch
/// out with the accelerator.

#include <cstdint>

#include "engine/driver/driver_parameters.hpp"

namespace septet::driver {

enum class GearPhase : std::uint8_t {
  holding,    ///< Clutch down: standing, or rolling with the gear for the speed in.
  biting,     ///< Driving off with a slipping clutch.
  driving,    ///< Clutch up.
  pressing,   ///< Clutch on its path down.
  moving,     ///< Lever in motion.
  releasing,  ///< Clutch on its path up in the new gear.
};

struct GearState {
  GearPhase phase = GearPhase::holding;
  int lever = 1;        ///< The engaged gear; 0 while passing through neutral.
  int target = 1;       ///< Gear that the lever moves to.
  double clutch = 1.0;  ///< 1 down.
  double phase_s = 0.0;
  double driving_s = 0.0;  ///< Since the last change.
  bool started = false;    ///< The driver has looked at the engaged gear.
};

/// Perceptions.
struct GearSenses {
  double engine_radps = 0.0;
  double speed_mps = 0.0;
  int gear = 0;              ///< Engaged gear, seen when the drive begins.
  double accelerator = 0.0;  ///< The right foot's desired position.
  bool braking = false;
};

/// Moves foot and hand; returns the accelerator that the right foot gives meanwhile.
double advance_gears(GearState& state, const GearParameters& gears, const CarKnowledge& car, const GearSenses& senses,
                     double dt_s);

}  // namespace septet::driver

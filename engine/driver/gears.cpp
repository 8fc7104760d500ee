#include "engine/driver/gears.hpp"

#include <algorithm>

namespace septet::driver {
namespace {

constexpr double bite_begins = 0.80, bite_ends = 0.20;  ///< Positions of the clutch pedal.
constexpr double walking_mps = 2.0;

void enter(GearState& state, GearPhase phase) {
  state.phase = phase;
  state.phase_s = 0.0;
}

double between(double light, double full, double accelerator) { return light + accelerator * (full - light); }

/// Gear that the engine's speed asks for, one step away at most.
int wished_gear(const GearState& state, const GearParameters& gears, const CarKnowledge& car,
                const GearSenses& senses) {
  const double up = between(gears.up_light_radps, gears.up_full_radps, senses.accelerator);
  const double down = between(gears.down_light_radps, gears.down_full_radps, senses.accelerator);
  if (senses.engine_radps > up && state.lever < car.gears) return state.lever + 1;
  if (senses.engine_radps < down && state.lever > 1) return state.lever - 1;
  return state.lever;
}

/// Engine speed in a gear with the clutch up.
double coupled_radps(const CarKnowledge& car, int gear, const GearSenses& senses) {
  return senses.speed_mps * car.engine_radps_per_mps[static_cast<std::size_t>(gear - 1)];
}

/// The gear for the speed at which the car rolls with the clutch down.
int rolling_gear(const GearParameters& gears, const CarKnowledge& car, const GearSenses& senses) {
  int gear = 1;
  while (gear < car.gears && coupled_radps(car, gear + 1, senses) > 1.2 * gears.down_light_radps) ++gear;
  return gear;
}

/// Out as fast as the engine keeps its speed, down again where it sags.
void let_bite(GearState& state, const GearParameters& gears, double engine_radps, double dt_s) {
  const double spare = engine_radps / gears.drive_off_radps - 0.8;
  const double rate_ps = std::clamp(3.0 * spare, -2.0, 1.0) * gears.bite_rate_ps;
  state.clutch = std::clamp(state.clutch - rate_ps * dt_s, 0.0, bite_begins);
}

}  // namespace

double advance_gears(GearState& state, const GearParameters& gears, const CarKnowledge& car, const GearSenses& senses,
                     double dt_s) {
  if (!state.started) {
    state.started = true;
    if (senses.gear > 0 && senses.speed_mps > walking_mps) {
      state.lever = state.target = senses.gear;
      state.clutch = 0.0;
      enter(state, GearPhase::driving);
    }
  }
  state.phase_s += dt_s;
  const bool wants_to_go = senses.accelerator > 0.02 && !senses.braking;
  const bool sags = senses.engine_radps < gears.clutch_in_radps;
  switch (state.phase) {
    case GearPhase::holding: {
      state.clutch = std::min(1.0, state.clutch + dt_s / gears.press_s);
      state.target = rolling_gear(gears, car, senses);
      if (state.clutch < 1.0 || state.phase_s < gears.press_s) return 0.0;
      if (state.lever != state.target) {
        enter(state, GearPhase::moving);
        return 0.0;
      }
      if (!wants_to_go) return 0.0;
      if (coupled_radps(car, state.lever, senses) > 1.2 * gears.clutch_in_radps) {
        enter(state, GearPhase::releasing);
      } else if (!sags) {
        state.clutch = bite_begins;
        enter(state, GearPhase::biting);
      }
      return gears.drive_off_accelerator;
    }
    case GearPhase::biting: {
      let_bite(state, gears, senses.engine_radps, dt_s);
      if (!wants_to_go) enter(state, GearPhase::holding);
      if (state.clutch <= bite_ends) {
        state.driving_s = 0.0;
        enter(state, GearPhase::driving);
      }
      // The foot eases off where the engine races against the slipping clutch.
      const double eager = std::clamp(2.0 - senses.engine_radps / gears.drive_off_radps, 0.0, 1.0);
      return wants_to_go ? eager * std::max(senses.accelerator, gears.drive_off_accelerator) : 0.0;
    }
    case GearPhase::driving:
      state.clutch = std::max(0.0, state.clutch - dt_s / gears.release_s);
      state.driving_s += dt_s;
      if (sags) {
        enter(state, GearPhase::holding);
        return 0.0;
      }
      // Braking keeps the engaged gear; the next one is chosen with the clutch down.
      state.target = senses.braking ? state.lever : wished_gear(state, gears, car, senses);
      if (state.target != state.lever && state.driving_s > gears.pause_s) enter(state, GearPhase::pressing);
      return senses.accelerator;
    case GearPhase::pressing:
      state.clutch = std::min(1.0, state.clutch + dt_s / gears.press_s);
      if (state.clutch >= 1.0) enter(state, GearPhase::moving);
      return 0.0;
    case GearPhase::moving:
      state.clutch = 1.0;
      state.lever = state.phase_s < 0.5 * gears.lever_s ? 0 : state.target;
      if (state.phase_s >= gears.lever_s) {
        const bool can_go = coupled_radps(car, state.target, senses) > 1.2 * gears.clutch_in_radps;
        enter(state, can_go && !senses.braking ? GearPhase::releasing : GearPhase::holding);
      }
      return 0.0;
    case GearPhase::releasing:
      state.clutch = std::max(0.0, state.clutch - dt_s / gears.release_s);
      if (coupled_radps(car, state.lever, senses) < gears.clutch_in_radps) {
        enter(state, GearPhase::holding);
      } else if (state.clutch <= bite_ends) {
        state.driving_s = 0.0;
        enter(state, GearPhase::driving);
      }
      return senses.accelerator * (1.0 - state.clutch);
  }
  return 0.0;
}

}  // namespace septet::driver

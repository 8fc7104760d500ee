#pragma once
/// Transitions of speed and of lateral offset (OpenSCENARIO XML 1.3, TransitionDynamics).
///
/// With p from 0 to 1 the value is from + (to − from) · f(p), f(p) being p (linear), (1 − cos πp)/2 (sinusoidal) or
/// p²(3 − 2p) (cubic); a step ends at once. Pure functions.

#include "engine/scenario/run/scenario_state.hpp"

namespace septet::scenario {

/// f(p) of the shape; p is clamped to [0, 1].
double shape_value(DynamicsShape shape, double p);
/// The greatest f′(p): 1, π/2 and 3/2. The transition's greatest rate is |to − from| / extent times this.
double shape_peak_rate(DynamicsShape shape);
/// The greatest |f″(p)|: π²/2 and 6; for the shapes with a kink 2, as if half the transition were spent on either end
/// of it.
double shape_peak_acceleration(DynamicsShape shape);

inline bool is_done(const Transition& transition) {
  return transition.shape == DynamicsShape::step || transition.progress >= transition.extent - 1e-9;
}
double value_of(const Transition& transition);
void advance_transition(Transition& transition, double dt_s, double distance_m);

/// A speed's transition. A distance is turned into the time it takes: all shapes are symmetric, so the mean speed is
/// that of both ends. `strongest_mps2` bounds the rate: the transition is stretched to keep it.
Transition speed_transition(const TransitionDynamics& dynamics, double from_mps, double to_mps, double strongest_mps2);
/// An offset's transition, in time, over a distance or at a rate.
Transition offset_transition(const TransitionDynamics& dynamics, double from_m, double to_m);
/// Transition with a bound on the lateral acceleration instead.
Transition bounded_offset_transition(DynamicsShape shape, double max_lateral_acceleration_mps2, double from_m,
                                     double to_m);

}  // namespace septet::scenario

#include "engine/scenario/run/transition.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace septet::scenario {

double shape_value(DynamicsShape shape, double p) {
  p = std::clamp(p, 0.0, 1.0);
  switch (shape) {
    case DynamicsShape::step:
      return 1.0;
    case DynamicsShape::linear:
      return p;
    case DynamicsShape::sinusoidal:
      return 0.5 * (1.0 - std::cos(std::numbers::pi * p));
    case DynamicsShape::cubic:
      return p * p * (3.0 - 2.0 * p);
  }
  return 1.0;
}

double shape_peak_rate(DynamicsShape shape) {
  if (shape == DynamicsShape::sinusoidal) return std::numbers::pi / 2.0;
  return shape == DynamicsShape::cubic ? 1.5 : 1.0;
}

double shape_peak_acceleration(DynamicsShape shape) {
  if (shape == DynamicsShape::sinusoidal) return std::numbers::pi * std::numbers::pi / 2.0;
  return shape == DynamicsShape::cubic ? 6.0 : 2.0;
}

namespace {

/// Seconds for a change at this greatest rate; 0 without a change, infinite at a rate of 0.
double change_time_s(DynamicsShape shape, double change, double rate) {
  return change > 0.0 ? change * shape_peak_rate(shape) / rate : 0.0;
}

}  // namespace

double value_of(const Transition& transition) {
  if (is_done(transition)) return transition.to;
  const double f = shape_value(transition.shape, transition.progress / transition.extent);
  return transition.from + (transition.to - transition.from) * f;
}

void advance_transition(Transition& transition, double dt_s, double distance_m) {
  transition.progress += transition.over_distance ? distance_m : dt_s;
}

Transition speed_transition(const TransitionDynamics& dynamics, double from_mps, double to_mps, double strongest_mps2) {
  Transition transition{dynamics.shape, false, 0.0, 0.0, from_mps, to_mps};
  if (dynamics.shape == DynamicsShape::step) return transition;
  const double change = std::abs(to_mps - from_mps);
  if (dynamics.dimension == DynamicsDimension::time) {
    transition.extent = dynamics.value;
  } else if (dynamics.dimension == DynamicsDimension::distance) {
    const double mean_mps = 0.5 * std::abs(from_mps + to_mps);
    transition.extent = mean_mps > 0.0 ? dynamics.value / mean_mps : 0.0;
  } else {
    transition.extent = change_time_s(dynamics.shape, change, dynamics.value);
  }
  transition.extent = std::max(transition.extent, change_time_s(dynamics.shape, change, strongest_mps2));
  return transition;
}

Transition offset_transition(const TransitionDynamics& dynamics, double from_m, double to_m) {
  Transition transition{dynamics.shape, false, dynamics.value, 0.0, from_m, to_m};
  transition.over_distance = dynamics.dimension == DynamicsDimension::distance;
  if (dynamics.dimension == DynamicsDimension::rate) {
    transition.extent = change_time_s(dynamics.shape, std::abs(to_m - from_m), dynamics.value);
  }
  return transition;
}

Transition bounded_offset_transition(DynamicsShape shape, double max_lateral_acceleration_mps2, double from_m,
                                     double to_m) {
  const double change = std::abs(to_m - from_m);
  return {shape, false,  std::sqrt(change * shape_peak_acceleration(shape) / max_lateral_acceleration_mps2),
          0.0,   from_m, to_m};
}

}  // namespace septet::scenario

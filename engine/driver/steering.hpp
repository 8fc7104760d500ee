#pragma once
/// Two-point visual steering.
///
/// Source: D. D. Salvucci and R. Gray, "A two-point visual control model of steering", Perception
/// 33 (2004), 1233–1248, eq. 3:
///
///     dφ = k_far dθ_far + k_near dθ_near + k_i min(θ_near, θ_max) dt
///
/// φ is the hand-wheel angle, θ the visual directions of a near and a far point of the path. Their gains belong to
/// their simulator's wheel; here they follow from the car: with yaw rate G·φ a small excursion y obeys y'' + G(k_far +
/// k_near) y' + (vG k_near / d_near) y = 0, from which the natural frequency and damping of returning to the path give
/// k_near = ω² d_near / (vG) and k_far = 2ζω/G − k_near.
///
/// G grows with speed. What adds up is therefore the yaw rate G·φ, not φ: else who winds the wheel up at 6 m/s and back
/// while he speeds up keeps a share of the bend in it.

#include "engine/driver/driver_parameters.hpp"
#include "engine/driver/driver_view.hpp"
#include "engine/driver/perception.hpp"

namespace septet::driver {

struct SteeringGains {
  double near = 0.0, far = 0.0, integral_per_s = 0.0;
};
/// Gains for a speed; below 5 m/s those for 5 m/s.
SteeringGains steering_gains(const SteeringParameters& steering, const CarKnowledge& car, double speed_mps);

/// Hand-wheel angle of a bend in a steady state: the bend's geometry, and understeer for the lateral acceleration that
/// banking does not balance. Curvature positive to the left; roll positive lifts the left side.
double steady_wheel_rad(const CarKnowledge& car, double speed_mps, double curvature_per_m, double roll_rad);

struct SteeringState {
  ReactionDelay<PathAngles> eyes;
  WanderingError position_error_m, heading_error_rad;
  bool has_seen = false;
  PathAngles last;              ///< As of the tick before.
  PathAngles unanswered;        ///< Changes that occurred while the eyes were off the road.
  double intended_rad = 0.0;    ///< φ.
  double yaw_gain_per_s = 0.0;  ///< G, as of the tick before.
  double hands_rad = 0.0;       ///< φ after the muscles' lag.
};

/// The hand wheel after `dt_s` more. With the eyes off the road only a share of the changes is acted upon, by
/// peripheral vision; the rest follows when they are back.
double advance_steering(SteeringState& state, const SteeringParameters& steering, const CarKnowledge& car,
                        const PathAngles& path, bool sees_road, double speed_mps, double now_s, double dt_s,
                        Random& random);

}  // namespace septet::driver

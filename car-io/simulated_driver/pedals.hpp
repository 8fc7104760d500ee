#pragma once
/// Speed and gap through one foot on two pedals.
///
/// The wish is an acceleration: the intelligent driver model (M. Treiber, A. Hennecke and D.
/// Helbing, "Congested traffic states in empirical observations and microscopic simulations", Phys.
/// Rev. E 62, 2000, eqs. 2–4) on what was seen a reaction time ago. The foot makes it come true
/// with what the driver knows of the car and, slowly, with what the seat tells.

#include <optional>

#include "car-io/simulated_driver/driver_parameters.hpp"
#include "car-io/simulated_driver/driver_view.hpp"
#include "car-io/simulated_driver/perception.hpp"

namespace septet::car_io {

/// Something ahead in the lane, as seen.
struct Obstacle {
  double gap_m = 0.0;
  double speed_mps = 0.0;
};

/// IDM acceleration behind an obstacle, or on a free road.
double wished_acceleration_mps2(const SpeedParameters& speed, double own_speed_mps,
                                double desired_speed_mps, const std::optional<Obstacle>& obstacle);

struct PedalState {
  ReactionDelay<std::optional<Obstacle>> eyes;
  WanderingError distance_error, speed_error;  ///< Relative.
  double wish_mps2 = 0.0;
  double seat_correction = 0.0;  ///< Accelerator that the driver has learnt to add.
  bool foot_on_brake = false;
  double foot_moves_s = 0.0;  ///< Time until the foot arrives at the other pedal.
  double accelerator = 0.0, brake = 0.0;
};

/// Moves the foot; the pedals are in the state.
void advance_pedals(PedalState& state, const SpeedParameters& speed, const CarKnowledge& car,
                    const OwnPlace& own, double desired_speed_mps,
                    const std::optional<Obstacle>& obstacle, double now_s, double dt_s,
                    Random& random);

}  // namespace septet::car_io

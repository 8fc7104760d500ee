#pragma once
/// Speed and gap through one foot on two pedals.
///
/// The target is an acceleration, based on the view of a reaction time ago: the intelligent driver model as improved
/// for adaptive cruise control (A. Kesting, M. Treiber and D. Helbing, "Enhanced intelligent driver model to access the
/// impact of driving strategies on traffic capacity", Phil. Trans. R. Soc. A 368, 2010, eqs. 2.3–2.7; free acceleration
/// and gap as in M. Treiber and A. Kesting, "Traffic Flow Dynamics", 2013, section 11.3.7). Its plain predecessor
/// brakes as in an emergency when a gap is shorter than desired, however harmless; here the leader is assumed to keep
/// its acceleration (the constant-acceleration heuristic), and the gap grows back with comfortable braking. The old
/// view is extrapolated at constant speed (M. Treiber, A. Kesting and D. Helbing, "Delays, inaccuracies and
/// anticipation in microscopic traffic models", Physica A 360, 2006, section 3.3). The foot realises the target with
/// the driver's knowledge of the car and, slowly, with the felt acceleration.

#include <optional>

#include "engine/driver/driver_parameters.hpp"
#include "engine/driver/driver_view.hpp"
#include "engine/driver/perception.hpp"

namespace septet::driver {

/// An obstacle ahead in the lane, as seen.
struct Obstacle {
  double gap_m = 0.0;
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;
  double worth_mps2 = 9.0;  ///< Largest braking that it justifies: less for one off the path.
};

/// Desired gap to a leader: eq. 2.2.
double wanted_gap_m(const SpeedParameters& speed, double own_speed_mps, double leader_speed_mps);
/// Braking that just keeps clear of an obstacle: eq. 2.4 for one that continues at its predicted speed of a second
/// later, if it brakes. (The paper's braking leader brakes to a stop; real ones seldom do, and a driver with that
/// assumption would brake hard for each of them.)
double heuristic_acceleration_mps2(double own_speed_mps, const Obstacle& obstacle);
/// Acceleration behind an obstacle, or on a free road: eq. 2.7.
double wished_acceleration_mps2(const SpeedParameters& speed, double own_speed_mps, double desired_speed_mps,
                                const std::optional<Obstacle>& obstacle);

struct PedalState {
  WanderingError distance_error, speed_error;  ///< Relative.
  double wish_mps2 = 0.0;
  double seat_correction = 0.0;  ///< Accelerator that the driver has learnt to add.
  bool foot_on_brake = false;
  double foot_moves_s = 0.0;  ///< Time until the foot arrives at the other pedal.
  double accelerator = 0.0, brake = 0.0;
};

/// Moves the foot; the pedals are in the state. The obstacle is as seen a reaction time ago (`remembered_vehicles`).
void advance_pedals(PedalState& state, const SpeedParameters& speed, const CarKnowledge& car, const OwnPlace& own,
                    double desired_speed_mps, std::optional<Obstacle> obstacle, double dt_s, Random& random);

}  // namespace septet::driver

#pragma once
/// Speed and gap through one foot on two pedals.
///
/// The wish is an acceleration, on what was seen a reaction time ago: the intelligent driver model as
/// improved for adaptive cruise control (A. Kesting, M. Treiber and D. Helbing, "Enhanced intelligent
/// driver model to access the impact of driving strategies on traffic capacity", Phil. Trans. R. Soc. A
/// 368, 2010, eqs. 2.3–2.7; free acceleration and gap as in M. Treiber and A. Kesting, "Traffic Flow
/// Dynamics", 2013, section 11.3.7). Its plain predecessor brakes like in an emergency when a gap is
/// shorter than wanted, however harmless; here the one ahead is taken to keep its acceleration (the
/// constant-acceleration heuristic), and the gap grows back with comfortable braking.
/// What was seen is taken to have gone on evenly since (M. Treiber, A. Kesting and D. Helbing, "Delays,
/// inaccuracies and anticipation in microscopic traffic models", Physica A 360, 2006, section 3.3).
/// The foot makes the wish come true with what the driver knows of the car and, slowly, with what the
/// seat tells.

#include <optional>

#include "engine/driver/driver_parameters.hpp"
#include "engine/driver/driver_view.hpp"
#include "engine/driver/perception.hpp"

namespace septet::driver {

/// Something ahead in the lane, as seen.
struct Obstacle {
  double gap_m = 0.0;
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;
  double worth_mps2 = 9.0;  ///< The most braking that it is worth: less for who is not in the way.
};

/// The gap that the driver would like behind somebody: eq. 2.2.
double wanted_gap_m(const SpeedParameters& speed, double own_speed_mps, double leader_speed_mps);
/// The braking that just keeps clear of an obstacle: eq. 2.4 for one that goes on at the speed that it
/// will have in a second, if it brakes. (The paper's braking leader brakes until it stands; people ahead seldom do, and
/// who believed it would stamp on the pedal for each of them.)
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

/// Moves the foot; the pedals are in the state. The obstacle is what was seen a reaction time ago (`remembered_vehicles`).
void advance_pedals(PedalState& state, const SpeedParameters& speed, const CarKnowledge& car, const OwnPlace& own,
                    double desired_speed_mps, std::optional<Obstacle> obstacle, double dt_s, Random& random);

}  // namespace septet::driver

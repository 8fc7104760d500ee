#pragma once
/// Choice of the lane, and the manoeuvre: decision, mirror, indicator, second look, change; and back again, if it turns
/// out to be unsafe before the line is crossed.
///
/// The decision weighs the acceleration that each lane offers (MOBIL's incentive without politeness: A. Kesting, M.
/// Treiber and D. Helbing, "General lane-changing model MOBIL for car-following models", 2007) with keeping to the
/// outer lanes, where overtaking is forbidden, and with the lane of an ambulance that the driver follows. The scene
/// behind is unknown without a glance, so that every change has its glances. A gap is accepted by time gap and closing
/// speed, ahead and behind, as predicted for the crossing of the line.

#include <optional>
#include <span>

#include "engine/driver/driver_parameters.hpp"
#include "engine/driver/driver_view.hpp"
#include "engine/driver/mirrors.hpp"
#include "engine/driver/pedals.hpp"

namespace septet::driver {

enum class LanePhase : std::uint8_t {
  keep,
  look,    ///< The mirror of the desired side.
  signal,  ///< The indicator is on.
  look_again,
  change,   ///< The wheel turns.
  go_back,  ///< To the lane in which the change began.
};

/// A path across, from the lane (0) to the target (1): least jerk (Flash and Hogan 1985) from any motion to rest.
struct LaneWay {
  double from = 0.0, from_rate_ps = 0.0, from_rate_change_ps2 = 0.0, to = 1.0, duration_s = 1.0;
};
struct WayPoint {
  double at = 0.0, rate_ps = 0.0, rate_change_ps2 = 0.0;
};
WayPoint point_on_way(const LaneWay& way, double time_s);

struct LaneState {
  LanePhase phase = LanePhase::keep;
  int lane = 0;          ///< The lane of the car; during a change the one that it began in.
  int target = 0;        ///< Target lane; equal to `lane` while keeping it.
  double phase_s = 0.0;  ///< Time in the phase; during the lateral motion it stops while the car stands.
  LaneWay way;           ///< While changing or going back.
  double since_change_s = 1e9;
  double next_thought_s = 0.0;
};

/// Inputs of the choice.
struct LaneScene {
  const OwnPlace& own;
  std::span<const SeenVehicle> vehicles;
  double desired_speed_mps = 0.0;
  bool grows_to_the_right = true;
  bool open_inside = false,
       open_outside = false;    ///< The lanes one number less and one more are drivable, here and ahead.
  double lane_ends_in_m = 1e9;  ///< For the present lane.
  /// On a route: the lane for its next turn, to which alone lanes are changed.
  std::optional<int> wanted_lane;
};

/// The vehicle ahead in a lane that requires the most braking; empty: none. An ambulance counts in every lane: it is
/// followed and never passed; from another lane the driver only stays behind, with comfortable braking.
std::optional<Obstacle> obstacle_in_lane(const LaneScene& scene, int lane, const SpeedParameters& speed);
/// The same on the car's path: in its lane; during a change, in the target lane, and in the old one until the whole
/// body has left it.
std::optional<Obstacle> obstacle_on_way(const LaneState& state, const LaneScene& scene, const SpeedParameters& speed);
/// True if a change into this lane leaves everyone room. Strictness scales the required gaps, and the time until then,
/// and relaxes the braking that may be imposed.
bool is_safe(const LaneScene& scene, int lane, const DriverParameters& driver, double strictness = 1.0);
/// The driver's intended share of the path from `lane` to `target`, some time from now.
double place_across(const LaneState& state, double own_speed_mps, double ahead_s);

/// Thinks, looks and decides. `looked` is the mirror whose glance just ended.
void advance_lane_choice(LaneState& state, const DriverParameters& driver, const LaneScene& scene, MirrorState& mirrors,
                         const std::optional<Mirror>& looked, double dt_s, Random& random);

}  // namespace septet::driver

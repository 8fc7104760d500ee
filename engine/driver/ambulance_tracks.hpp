#pragma once
/// Driving in an ambulance's tracks: traffic that makes way leaves a lane where the ambulance drives, on
/// the line between two lanes, and closes it again some way behind. Who stays near drives through.
///
/// Across the road is counted from its reference line, positive to the driver's left (OwnPlace,
/// SeenVehicle). Pure functions of their arguments.

#include <optional>
#include <span>
#include <vector>

#include "engine/driver/driver_view.hpp"
#include "engine/driver/lane_choice.hpp"

namespace septet::driver {

struct TracksState {
  struct Point {
    double x_m = 0.0, across_m = 0.0;
  };
  std::vector<Point> points;  ///< Where the ambulance was seen to drive, ascending x; not far behind the driver.
  ParticipantId ambulance = 0;
  bool follows = false;
  LaneWay way{.from = 0.0, .to = 0.0};  ///< From the lane (0) into the tracks (1), or back.
  double way_s = 0.0;
};

/// Remembers where the ambulance ahead drives, and decides whether the driver follows in its tracks:
/// it is within `within_m`, has driven by here, and nobody is in the way over to them.
void look_at_tracks(TracksState& state, const traffic::Corridor& corridor, const OwnPlace& own,
                    std::span<const SeenVehicle> vehicles, double within_m, double duration_s);
void advance_tracks(TracksState& state, double dt_s);

/// How far the driver means to be in the tracks, from 0 to 1, some time from now.
double share_of_tracks(const TracksState& state, double ahead_s);
/// Across the road; beyond what was seen as where it ended.
double across_at(const TracksState& state, double x_m);

/// Of the ambulance and those who stand where the driver goes, the one that asks for the most braking.
std::optional<Obstacle> obstacle_in_tracks(const TracksState& state, const LaneScene& scene,
                                           const SpeedParameters& speed);

}  // namespace septet::driver

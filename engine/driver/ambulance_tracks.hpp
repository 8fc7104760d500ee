#pragma once
/// Driving in an ambulance's tracks: traffic that yields leaves a lane for the ambulance, on the line between two
/// lanes, and closes it again some distance behind. A driver who stays near drives through.
///
/// Across the road is measured from its reference line, positive to the driver's left (OwnPlace, SeenVehicle). Pure
/// functions of their arguments.

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
  std::vector<Point> points;  ///< Seen places of the ambulance, ascending x; not far behind the driver.
  ParticipantId ambulance = 0;
  bool follows = false;
  LaneWay way{.from = 0.0, .to = 0.0};  ///< From the lane (0) into the tracks (1), or back.
  double way_s = 0.0;
};

/// Records the path of the ambulance ahead, and decides whether the driver follows in its tracks: it is within
/// `within_m`, has driven by here, and the path over to them is free.
void look_at_tracks(TracksState& state, const traffic::Corridor& corridor, const OwnPlace& own,
                    std::span<const SeenVehicle> vehicles, double within_m, double duration_s);
void advance_tracks(TracksState& state, double dt_s);

/// The driver's intended share of the tracks, from 0 to 1, some time from now.
double share_of_tracks(const TracksState& state, double ahead_s);
/// Across the road; beyond the recorded path as at its end.
double across_at(const TracksState& state, double x_m);

/// The vehicle that requires the most braking: the ambulance, or one on the driver's path.
std::optional<Obstacle> obstacle_in_tracks(const TracksState& state, const LaneScene& scene,
                                           const SpeedParameters& speed);

}  // namespace septet::driver

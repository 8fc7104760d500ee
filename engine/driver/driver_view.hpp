#pragma once
/// The driver's view from the seat: the place in the lane, the road ahead, and the vehicles around.
///
/// A function of a const Snapshot, of those whom the driver knows to be there (known_world.hpp), and the road alone. Lanes are counted as the corridor counts them, outwards from the
/// middle of the road; "left" and "right" are the driver's.

#include <optional>
#include <span>
#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"
#include "engine/traffic/corridor.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::driver {

/// Place of the driver's own car.
struct OwnPlace {
  road::RoadPosition position;
  double x_m = 0.0;  ///< Along the corridor, of the car's origin.
  int lane = 0;
  double offset_m = 0.0;  ///< From the lane's centre, positive to the left.
  double across_m = 0.0;  ///< From the road's reference line, positive to the left.
  double half_width_m = 0.9;
  /// From the body's sides to the lines of the lane; negative: over the line.
  double room_left_m = 0.0, room_right_m = 0.0;
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;      ///< Forward.
  double front_m = 0.0, rear_m = 0.0;  ///< From the origin to the bumpers.
};

struct SeenVehicle {
  ParticipantId id = 0;
  int lane = 0;                                ///< Containing its middle, or nearest to it.
  int innermost_lane = 0, outermost_lane = 0;  ///< Lanes that its body covers, or will within a second.
  double x_m = 0.0;                            ///< Along the corridor, of its origin.
  double across_m = 0.0, across_soon_m = 0.0;  ///< As in OwnPlace; soon: within a second, at its present lateral speed.
  double half_width_m = 0.9;
  bool is_ahead = false;
  double gap_m = 0.0;  ///< Bumper to bumper; negative while it is alongside.
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;  ///< Derived from its changing speed.
  bool is_ambulance = false;       ///< With its beacon on.
  double warned_ago_s = 1e9;       ///< Since its hazard lights were last seen lit.
};

/// True while its hazard lights flash, including the dark half seconds.
inline bool warns(const SeenVehicle& vehicle) { return vehicle.warned_ago_s < 1.0; }

/// Bearings of two points of the intended path from the car's origin, against its heading, positive
/// to the left.
struct PathAngles {
  double near_rad = 0.0, far_rad = 0.0;
};

/// The corridor that the car is in; empty off the road.
std::optional<traffic::Corridor> find_corridor(const road::RoadNetwork& network, const Snapshot& snapshot);

/// Empty if the car is off the corridor.
std::optional<OwnPlace> see_own_place(const road::RoadNetwork& network, const traffic::Corridor& corridor,
                                      const Snapshot& snapshot, const std::optional<road::RoadPosition>& hint);

/// Of those around `self`, who is one of them, all in the corridor's lanes, or about to be, within 250 m, by ascending id.
/// Vehicles on the shoulder are excluded. Accelerations stay 0.
std::vector<SeenVehicle> see_vehicles(const road::RoadNetwork& network, const traffic::Corridor& corridor,
                                      std::span<const Participant> around, ParticipantId self, const OwnPlace& own);

/// Estimates accelerations from the changes since the look `dt_s` before: the eye takes half a second. Also carries
/// over earlier flashing lights.
void see_accelerations(std::span<const SeenVehicle> before, double dt_s, std::vector<SeenVehicle>& now);

/// Vehicles seen some time ago, extrapolated to now at constant speed.
std::vector<SeenVehicle> remembered_vehicles(std::vector<SeenVehicle> seen, double ago_s, double own_speed_mps);

/// True if lane numbers grow to the right, as in right-hand traffic.
bool lanes_grow_to_the_right(const traffic::CorridorPiece& piece);

}  // namespace septet::driver

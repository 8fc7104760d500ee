#pragma once
/// Who has right of way at the next junction of a driver's route, and whether to wait for him at the line.
///
/// The stretches in which ways meet and who yields on them are those of the traffic (engine/traffic/network/lane_graph.hpp). Those
/// of whom the driver knows are taken to go on along the ways on which they are, as their indicators tell, at their
/// speed; whoever is within such a stretch, or would be while the driver is, is waited for. At a stop sign the car
/// stands once. World frame, metres, seconds. Pure functions but for the state, which is an argument.

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "engine/driver/driver_parameters.hpp"
#include "engine/driver/driver_view.hpp"
#include "engine/driver/route_ahead.hpp"

namespace septet::driver {

struct JunctionState {
  std::optional<double> waits_at_m;                            ///< x of the line, for the car's front.
  double speed_mps = std::numeric_limits<double>::infinity();  ///< Allowed by what is not in view before the line.
  std::size_t stood_before = 0;        ///< Step of the junction before whose stop line the car has stood.
  double waited_s = 0.0;               ///< Standing at the line.
  std::optional<double> crossed_at_m;  ///< x at which somebody comes across, within a junction.
  bool waits() const { return waits_at_m.has_value(); }
};

/// A look, `dt_s` after the last one. `judgement`: relative error of others' arrival.
void look_at_junction(JunctionState& state, RouteAhead& ahead, const traffic::Corridor& corridor,
                      const CourseParameters& course, const road::RoadNetwork& network,
                      std::span<const Participant> around, ParticipantId self, const OwnPlace& own,
                      std::span<const SeenVehicle> vehicles, double judgement, double dt_s);

/// x at which somebody who comes across is, or will be when the car's front is there; empty: nobody is within the next
/// metres of the driver's path.
std::optional<double> crossed_at_m(const traffic::Corridor& corridor, const road::RoadNetwork& network,
                                   std::span<const Participant> around, ParticipantId self, const OwnPlace& own,
                                   int lane);

}  // namespace septet::driver

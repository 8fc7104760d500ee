#pragma once
/// The natural end of a drive.

#include <optional>

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"
#include "engine/simulation/state.hpp"
#include "logging/session/drive_end.hpp"

namespace septet::server {

/// The game is over, the storyboard's StopTrigger has fired, or the driver's car is beyond the road's end. Empty: the
/// drive goes on, as it does while an impact is being recorded.
std::optional<logging::DriveEnd> natural_end(const simulation::Model& model, const simulation::State& state);

/// True if the point is more than 10 m beyond an end of the road without a successor. `road`: the nearest road
/// position, as found by `road::locate`.
bool is_beyond_road_end(const road::RoadNetwork& roads, const road::RoadPosition& road, const Vec2& world_m);

}  // namespace septet::server

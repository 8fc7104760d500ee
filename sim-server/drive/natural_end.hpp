#pragma once
/// Whether a drive has come to an end of its own.

#include <optional>

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"
#include "engine/simulation/state.hpp"
#include "logging/session/drive_end.hpp"

namespace septet::server {

/// The storyboard's StopTrigger has fired, or the driver's car is beyond the road's end. Nothing while the drive goes on.
std::optional<logging::DriveEnd> natural_end(const simulation::Model& model, const simulation::State& state);

/// Whether the point lies more than 10 m beyond an end of the road, at which no other road goes on. `road` is the road
/// position that `road::locate` found nearest to it.
bool is_beyond_road_end(const road::RoadNetwork& roads, const road::RoadPosition& road, const Vec2& world_m);

}  // namespace septet::server

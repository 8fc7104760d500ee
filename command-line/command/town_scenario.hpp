#pragma once
/// The scenario of a road file that has none of its own, as of a town from a map: `septet drive --scenario town.xodr`.
///
/// The driver's car begins on the longest street from which a drive goes on, with a swarm around it. Vehicles' lights go
/// through phases: those on the first approach of a junction, and on those that come against it or with it, have green
/// together, then the others. Pure but for `scenario_beside`.

#include <filesystem>
#include <string>

#include "engine/core/expected.hpp"
#include "engine/road/road_network.hpp"

namespace septet::server {

/// OpenSCENARIO XML that names the road by `road_file`. Error: nowhere in the network can a car drive.
Expected<std::string> town_scenario(const road::RoadNetwork& network, const std::string& road_file);

/// The scenario beside a road: NAME.xosc, which is written where there is none yet, and told. Errors: as above; the road cannot be
/// read; the file cannot be written.
Expected<std::filesystem::path> scenario_beside(const std::filesystem::path& road);

}  // namespace septet::server

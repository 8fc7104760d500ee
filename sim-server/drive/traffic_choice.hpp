#pragma once
/// The traffic engine of a drive, chosen by name.

#include <memory>
#include <string>

#include "engine/simulation/model.hpp"
#include "engine/traffic/traffic_engine.hpp"

namespace septet::server {

/// Error: no such engine.
Expected<void> check_traffic(const std::string& name);

/// "own": Septet's models; "sumo": SUMO as another process. `model` outlives the engine. Error: no such engine, or SUMO
/// is not installed.
Expected<std::unique_ptr<traffic::TrafficEngine>> open_traffic(const std::string& name, const simulation::Model& model);

}  // namespace septet::server

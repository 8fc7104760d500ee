#pragma once
/// Constant inputs of a session's sound, beside the ticks: the car, and the places that echo.

#include <vector>

#include "engine/audio/heard.hpp"
#include "engine/road/road_network.hpp"
#include "logging/session/session_reader.hpp"

namespace septet::sound {

/// Sound of the session's vehicle and rig; missing values are those of a Volvo S80.
audio::CarSound car_sound_of(const logging::SessionInfo& info);

/// Road of the session; empty if it has none that can be read.
road::RoadNetwork roads_of(const logging::SessionInfo& info);

/// Boxes of the tunnels: the parts of the scene without sky.
Expected<std::vector<audio::EchoBox>> echo_boxes_of(const logging::SessionReader& session);

}  // namespace septet::sound

#pragma once
/// What a session says of its sound besides the ticks: the car, and where it echoes.

#include <vector>

#include "engine/audio/heard.hpp"
#include "engine/road/road_network.hpp"
#include "logging/session_reader.hpp"

namespace septet::sound {

/// Of the vehicle and the rig that were driven with; what the session lacks is as in a Volvo S80.
audio::CarSound car_sound_of(const logging::SessionInfo& info);

/// The road that was driven on; none where the session has none that can be read.
road::RoadNetwork roads_of(const logging::SessionInfo& info);

/// The tunnels: boxes of the scene that see no sky.
Expected<std::vector<audio::EchoBox>> echo_boxes_of(const logging::SessionReader& session);

}  // namespace septet::sound

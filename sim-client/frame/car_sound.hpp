#pragma once
/// Constant inputs of the sound: the driver's car, and the places that echo.

#include <vector>

#include "engine/audio/heard.hpp"
#include "engine/instant/scene_summary.hpp"
#include "engine/physics/vehicle/vehicle_parameters.hpp"

namespace septet::frame {

/// Inputs of the car; `ear_m`: vehicle frame.
audio::CarSound car_sound(const vehicle::VehicleParameters& vehicle, const Vec3& ear_m);

/// Boxes of the tunnels: the parts of the scene without sky.
std::vector<audio::EchoBox> echo_boxes(const instant::SceneSummary& scene);

}  // namespace septet::frame

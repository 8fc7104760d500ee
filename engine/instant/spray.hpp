#pragma once
/// Spray: fine droplets that wheels raise from a wet road, as puffs of smoke that scatter nearly all light.
///
/// A puff leaves a vehicle at fixed times of the simulation, swirls after it for a part of a second, grows and settles.
/// It depends on the vehicle's number, its present motion and the time alone: screens, replay and film draw the same.
/// The optical depth along the middle of the cloud is that of sight::spray_wake: a lorry's cloud is 3 m high and thins over
/// some 30 m, a car's is 1.5 m high and thins over some 12 m.

#include <span>
#include <vector>

#include "engine/instant/frame_input.hpp"

namespace septet::instant {

/// Optical depth along a vehicle's wake, for the wetness of the road.
float spray_depth(const DrawnParticipant& vehicle, double road_wetness);

/// Appends a vehicle's puffs at an instant.
void add_spray(const DrawnParticipant& vehicle, const Environment& environment, double simulated_time_s,
               std::vector<SmokePuff>& puffs);

}  // namespace septet::instant

#pragma once
/// Spray: fine droplets that wheels raise from a wet road, as puffs of smoke that scatter nearly all light.
///
/// A puff leaves a vehicle at fixed times of the simulation, swirls after it for a part of a second, grows and settles.
/// It depends on the vehicle's number, its present motion and the time alone: screens, replay and film draw the same.
/// The optical depth along the middle of the cloud is `spray_depth`: zero below 8 m/s, then with the square of the
/// speed, and with the water on the road. That of a lorry at 25 m/s in standing water takes 70 % of the light (measured
/// losses run from 20 to 70 %), in a cloud 3 m high that thins over some 30 m; that of a car takes a quarter, 1.5 m
/// high over some 12 m.

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

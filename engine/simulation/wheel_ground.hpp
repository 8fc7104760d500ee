#pragma once
/// Ground under a wheel of the driver's car: the road's surface or a raised area on it, and the friction there.
///
/// Friction comes from the weather (wetness, snow and temperature of the scenario's environment), from the material of
/// the lane, and from patches on it (OpenDRIVE; their surface "wet", "snow" or "ice" goes with temperature, any other
/// is paved and goes with the weather, too); remaining black ice on a lane lies over them. RoadCondition's
/// frictionScaleFactor multiplies all of it.

#include <optional>
#include <span>

#include "engine/physics/vehicle/ground.hpp"
#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"
#include "engine/roadside/raised_areas.hpp"
#include "engine/roadside/terrain.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

inline constexpr double surface_reach_m = 60.0;  ///< Distance from a road to which its surface extends.

/// The road's weather, the same for all wheels of a tick.
struct RoadWeather {
  double wetness = 0.0, snow_cover = 0.0, temperature_k = 288.15;
  double friction_scale = 1.0;
  std::span<const BlackIce> black_ice;
  double thawed_kh = 0.0;
};
/// That of a state, which outlives it.
RoadWeather road_weather(const State& state);

/// Finds the ground under a wheel with its centre at `centre_m`. `place` is the wheel's last place (read where
/// `has_place`) and becomes the present one. Returns its distance outside the lanes, where the surface continues from
/// its edge; empty where no road is near. `raised` may be null: there is nothing.
std::optional<double> find_wheel_ground(const road::RoadNetwork& roads, const roadside::RaisedAreas* raised,
                                        const RoadWeather& weather, const Vec3& centre_m, bool has_place,
                                        road::RoadPosition& place, vehicle::WheelGround& wheel);

/// Finds the land beside the roads under a wheel: its height, and grass in the weather. `place`: of a road near it, or
/// null.
void find_land(const road::RoadNetwork& roads, const roadside::Terrain& terrain, const RoadWeather& weather,
               const Vec3& centre_m, const road::RoadPosition* place, vehicle::WheelGround& wheel);

double surface_friction(const road::SurfaceMaterial* material, const RoadWeather& weather);

}  // namespace septet::simulation

#pragma once
/// Edges of kerbs and steps around a wheel of the driver's car.

#include "engine/physics/vehicle/ground.hpp"
#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"
#include "engine/roadside/raised_areas.hpp"

namespace septet::simulation {

/// Looks for steps up, a wheel's radius before and behind its centre, and before it a tick's travel `way_m` farther:
/// sets `wheel.edges`. `ahead`: the car's heading, level, unit length. Costs nothing where a road does not step
/// (ground_faces.hpp), far from raised areas. `raised` may be null: there is nothing.
void find_step_edges(const road::RoadNetwork& roads, const roadside::RaisedAreas* raised, const Vec3& centre_m,
                     const Vec2& ahead, double radius_m, const road::RoadPosition& place, vehicle::WheelGround& wheel,
                     double way_m = 0.0);

}  // namespace septet::simulation

#pragma once
/// Wheels: tyre and rim, the axle along y, the outer side towards +y (left wheels). Metres.

#include "engine/geometry/polygon_mesh.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {

struct WheelSize {
  float radius_m = 0.32f, width_m = 0.215f;
  int spokes = 5;
};

geometry::PolygonMesh wheel_mesh(const WheelSize& size, DetailLevel level);

/// Adds near and middle wheels at the four corners given by wheelbase and track.
void add_wheels(VehicleParts& parts, const VehicleModel& model, const WheelSize& size);

/// Adds one pair of wheels, both levels, that turns with the rear axle (or steers with the front one).
void add_axle(VehicleParts& parts, const WheelSize& size, float x_m, float half_track_m, bool front);

}  // namespace septet::scenery

#pragma once
/// Place of the eyes of the person who drives, rides or walks, by the shape of what is drawn around them.

#include "engine/math/rigid_transform.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::scenery {

/// Eye point, vehicle frame, of the driver of such a vehicle, whose seat is on the left; of a rider and of a walker. Of
/// what nobody drives (a trailer, a caravan) a point high in the middle.
Vec3 eye_in(const VehicleModel& model);

}  // namespace septet::scenery

#pragma once
/// What the driver of a vehicle without a cockpit has around them beside its body: dashboard, steering wheel, mirrors.

#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {

/// Fittings of a model, around its eye point (eye_point.hpp); materials are Finish indices. Empty for whoever has none.
VehicleParts fittings(const VehicleModel& model);

}  // namespace septet::scenery

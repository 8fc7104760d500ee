#pragma once
/// What the driver of a vehicle without a cockpit has around them beside its body: dashboard, steering wheel, mirrors.

#include <optional>

#include "engine/math/rigid_transform.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {

/// Fittings of a model, around its eye point (eye_point.hpp); materials are Finish indices. Empty for whoever has none.
VehicleParts fittings(const VehicleModel& model);

/// Pose in the vehicle of a frame in which the panel of instruments stands as it does in its car
/// (engine/world/instrument_panel.hpp), so that it lies on this vehicle's dashboard and looks at the driver's eyes. Empty for whoever has none.
std::optional<RigidTransform> dials_in(const VehicleModel& model);

}  // namespace septet::scenery

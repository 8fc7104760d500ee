#pragma once
/// Models by what is known of their inside.

#include "engine/world/vehicle_model.hpp"

namespace septet::scenery {

/// True for the model with a whole cockpit: dials, wheel, hands, wipers (interior_parts). It is the driver's car.
inline bool has_cockpit(const VehicleModel& model) { return model.name == "volvo-s80"; }

/// False for what is towed and for boxes: nobody looks out of them.
inline bool is_driven(const VehicleModel& model) {
  return model.name != "caravan" && model.name != "semitrailer" && model.kind != ParticipantKind::object;
}

}  // namespace septet::scenery

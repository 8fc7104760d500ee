#pragma once
/// Vehicles of the catalogue as prototypes of the scene.

#include <span>

#include "engine/roadside/parked_cars.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scenery/own_models.hpp"

namespace septet::scenery {

/// Adds "model/NAME" for every entry of vehicle_models(), with turning wheels and lamps by role and three levels of
/// detail, and "model/interior/volvo-s80": the driver's view of his own car, for rigs that have no car around the
/// driver; "model/interior/NAME" of every other model that somebody drives, rides or walks; "model/head/NAME" of riders
/// and walkers, for its shadow; "model/cockpit/hands", "…/instruments", "…/dials", "…/signs" and "…/water" go with it.
///
/// Models in `own` replace these, the same at all distances. `parked` are placed in the world.
void build_vehicles(scene::SceneBuilder& builder, const OwnModels* own = nullptr,
                    std::span<const roadside::ParkedCar> parked = {});

}  // namespace septet::scenery

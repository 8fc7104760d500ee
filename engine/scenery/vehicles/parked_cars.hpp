#pragma once
/// Parked cars: the catalogue's, without lamps and turning wheels, as things of the world.

#include <span>

#include "engine/roadside/parked_cars.hpp"
#include "engine/scenery/palette.hpp"

namespace septet::scenery {

/// `palette`: the finishes of vehicles (finish.hpp).
void build_parked_cars(scene::SceneBuilder& builder, const Palette& palette, std::span<const roadside::ParkedCar> cars);

}  // namespace septet::scenery

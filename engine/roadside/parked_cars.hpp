#pragma once
/// Cars that stand in the parking lanes of a town's streets, for the scenery that draws them and the cars that run
/// against them.
///
/// The same network and seed give the same cars. World frame, metres.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/roadside/road_shape.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::roadside {

struct ParkedCar {
  ModelIndex model = 0;
  std::uint8_t paint = 0;
  RigidTransform world_from_vehicle;
};

inline constexpr std::size_t most_parked_cars = 1500;

/// Cars along lanes of type parking, with gaps between them.
std::vector<ParkedCar> parked_cars(const RoadShape& roads, std::uint64_t seed);

}  // namespace septet::roadside

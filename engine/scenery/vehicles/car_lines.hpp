#pragma once
/// Lines on a car's body that more than its paint follows: seams of the doors, rows of lamps. Vehicle frame, metres.

#include "engine/scenery/vehicles/car_body.hpp"

namespace septet::scenery {

/// True for a body built from a car's lines (car_shape).
bool has_car_lines(const VehicleModel& model);

/// x of the seams of the doors, from below the belt line; z of their lower and upper ends.
struct DoorSeams {
  float front, middle, rear_low, rear_high;
  float low, belt;
};
DoorSeams door_seams(const VehicleModel& model, const CarShape& shape);

/// A lamp housing: |y| from the inner to the outer edge, z of its edges.
struct LampPlace {
  float inner, outer, low, top;
};
LampPlace head_lamp(const VehicleModel& model, const CarShape& shape);
LampPlace tail_lamp(const VehicleModel& model, const CarShape& shape);

}  // namespace septet::scenery

#include "engine/scenery/vehicles/vehicle_parts.hpp"

#include "engine/geometry/mesh_measures.hpp"

namespace septet::scenery {

void set_detail(VehiclePart& part, DetailLevel level) {
  for (Placement& place : part.places) {
    place.visible_from_m = level == DetailLevel::near     ? 0.0f
                           : level == DetailLevel::middle ? near_until_m
                                                          : middle_until_m;
    place.visible_to_m = level == DetailLevel::near     ? near_until_m
                         : level == DetailLevel::middle ? middle_until_m
                                                        : vehicles_until_m;
  }
}

VehicleParts vehicle_parts(const VehicleModel& model) {
  switch (model.kind) {
    case ParticipantKind::lorry:
      return lorry_parts(model);
    case ParticipantKind::motorcycle:
      return motorcycle_parts(model);
    case ParticipantKind::pedestrian:
      return pedestrian_parts(model);
    default:
      return car_parts(model);
  }
}

std::size_t triangles_at(const VehicleParts& parts, float distance_m) {
  std::size_t count = 0;
  for (const VehiclePart& part : parts)
    for (const Placement& place : part.places)
      if (distance_m >= place.visible_from_m && distance_m < place.visible_to_m)
        count += geometry::triangle_count(part.mesh, part.subdivision_level);
  return count;
}

}  // namespace septet::scenery

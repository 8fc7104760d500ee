#include "engine/scenery/vehicles/vehicle_parts.hpp"

#include <utility>

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

const char* suffix_of(DetailLevel level) {
  return level == DetailLevel::near ? " near" : level == DetailLevel::middle ? " middle" : " far";
}

void add_level(VehicleParts& parts, VehicleParts of_level, DetailLevel level) {
  for (VehiclePart& part : of_level) {
    if (part.mesh.polygons.empty()) continue;
    part.name += suffix_of(level);
    set_detail(part, level);
    parts.push_back(std::move(part));
  }
}

VehicleParts vehicle_parts(const VehicleModel& model) {
  switch (model.kind) {
    case ParticipantKind::bus:
      return bus_parts(model);
    case ParticipantKind::bicycle:
      return bicycle_parts(model);
    case ParticipantKind::lorry:
      if (model.name == "farm-tractor") return farm_tractor_parts(model);
      return lorry_parts(model);
    case ParticipantKind::motorcycle:
      return motorcycle_parts(model);
    case ParticipantKind::pedestrian:
      return pedestrian_parts(model);
    case ParticipantKind::object:
      return box_parts();
    default:
      if (model.name == "caravan") return caravan_parts(model);
      return car_parts(model);
  }
}

}  // namespace septet::scenery

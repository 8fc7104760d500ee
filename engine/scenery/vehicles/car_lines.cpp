#include "engine/scenery/vehicles/car_lines.hpp"

namespace septet::scenery {

bool has_car_lines(const VehicleModel& model) {
  return (model.kind == ParticipantKind::car || model.kind == ParticipantKind::van ||
          model.kind == ParticipantKind::ambulance) &&
         model.name != "caravan";
}

DoorSeams door_seams(const VehicleModel& model, const CarShape& shape) {
  const auto axle = static_cast<float>(model.wheelbase_m), radius = static_cast<float>(model.wheel_radius_m);
  const float roof_front = axle - shape.roof_front_m, low = shape.ground_m + 0.14f,
              belt = shape.belt_front_m + 0.035f - 0.03f;
  const float front = axle - radius * 1.2f - 0.14f;
  if (model.kind != ParticipantKind::car) {
    const float middle = roof_front - 0.80f;
    return {front, middle, middle - 1.2f, middle - 1.2f, low, belt};
  }
  return {front, roof_front - 0.64f, radius * 1.2f + 0.10f, radius * 0.9f + 0.04f, low, belt};
}

LampPlace head_lamp(const VehicleModel& model, const CarShape& shape) {
  const float nose = static_cast<float>(model.width_m / 2) * shape.nose_half_width;
  const float top = shape.hood_front_m - 0.115f;
  return {0.50f * nose, 0.93f * nose, top - (model.kind != ParticipantKind::car ? 0.19f : 0.135f), top};
}

LampPlace tail_lamp(const VehicleModel& model, const CarShape& shape) {
  const float tail = static_cast<float>(model.width_m / 2) * shape.tail_half_width;
  if (model.kind != ParticipantKind::car) return {0.80f * tail, 0.95f * tail, 0.80f, 1.30f};
  return {0.56f * tail, 0.95f * tail, shape.tail_m - 0.235f, shape.tail_m - 0.055f};
}

}  // namespace septet::scenery

#include "engine/world/participant_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/check.hpp"

namespace septet {
namespace {

/// Bytes of a damaged log may tell any size.
double length_m(double logarithm) { return std::exp2(std::clamp(logarithm, -10.0, 10.0)); }

}  // namespace

ModelIndex box_model() {
  static const ModelIndex index = [] {
    const auto found = find_vehicle_model("box");
    SEPTET_CHECK(found.has_value(), "no model of a box among {}", vehicle_models().size());
    return *found;
  }();
  return index;
}

bool is_box(const Participant& participant) { return participant.model == box_model(); }

void set_box_size(const Vec3& size_m, Participant& box) {
  box.wheel_lift_m = {std::log2(size_m.x), std::log2(size_m.y), std::log2(size_m.z), 0.0};
}

Vec3 box_size_m(const Participant& box) {
  const std::array<double, 4>& told = box.wheel_lift_m;
  return {length_m(told[0]), length_m(told[1]), length_m(told[2])};
}

std::optional<Vec3> box_size_of(const Participant& participant) {
  return is_box(participant) ? std::optional(box_size_m(participant)) : std::nullopt;
}

VehicleModel box_shape(const Vec3& size_m) {
  VehicleModel shape = vehicle_models()[box_model()];
  shape.length_m = size_m.x;
  shape.width_m = size_m.y;
  shape.height_m = size_m.z;
  shape.rear_overhang_m = 0.5 * size_m.x;
  return shape;
}

VehicleModel shape_of(const Participant& participant) { return shape_of(participant.model, box_size_of(participant)); }

VehicleModel shape_of(ModelIndex model, const std::optional<Vec3>& box_size_m) {
  return box_size_m ? box_shape(*box_size_m) : vehicle_models()[model];
}

}  // namespace septet

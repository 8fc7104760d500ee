#pragma once
/// What a participant measures. Vehicles and people measure what their model does (vehicle_model.hpp); an object of a
/// scenario is a box, each of its own size, and one model stands for all.
///
/// The size of a box travels where a vehicle's wheel lifts do (Participant::wheel_lift_m), for a box has no wheels: as
/// binary logarithms of length, width and height in metres, so that range and step of the wire (wire_snapshot.hpp)
/// serve a tin and a hall, to 0.01 %.

#include <optional>

#include "engine/world/snapshot.hpp"

namespace septet {

/// The model of all boxes.
ModelIndex box_model();

bool is_box(const Participant& participant);

/// Length, width and height: positive, finite.
void set_box_size(const Vec3& size_m, Participant& box);
Vec3 box_size_m(const Participant& box);

/// The same of any participant; empty for those that are no boxes.
std::optional<Vec3> box_size_of(const Participant& participant);

/// A box of this size; its origin is the middle of its bottom.
VehicleModel box_shape(const Vec3& size_m);

/// Dimensions of any participant, by itself or by its model and what box_size_of has told of it.
VehicleModel shape_of(const Participant& participant);
VehicleModel shape_of(ModelIndex model, const std::optional<Vec3>& box_size_m);

}  // namespace septet

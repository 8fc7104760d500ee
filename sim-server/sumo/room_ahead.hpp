#pragma once
/// Room in front of a vehicle, as its driver sees it over the bonnet: what stands in the strip that is as wide as the
/// vehicle, or little more, and lies straight ahead of it. Plan view, world frame, metres. Pure.

#include <array>
#include <span>

#include "engine/math/rigid_transform.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::server {

/// A body's four corners, in the order in which one walks round it.
using PlanOutline = std::array<Vec2, 4>;

PlanOutline plan_outline(const RigidTransform& world_from_vehicle, const VehicleModel& model);

/// From the front bumper to the nearest of the others in the strip, which is wider than the vehicle by `beside_m` on
/// either side; infinite if there is nobody. Bodies that begin behind the rear axle do not count: so the vehicle itself
/// may be among the others.
double room_ahead_m(const RigidTransform& world_from_vehicle, const VehicleModel& model, double beside_m,
                    std::span<const PlanOutline> others);

}  // namespace septet::server

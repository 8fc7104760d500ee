#pragma once
/// Mirrors of vehicles other than the driver's car, whose mirrors are its rig's.

#include <vector>

#include "engine/math/rigid_transform.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::scenery {

/// Glass of a mirror, vehicle frame. It is turned so that the driver sees the road behind in it.
struct VehicleMirror {
  Vec3 middle_m{0.0};
  Vec3 normal{-1.0, 0.0, 0.0};  ///< Of its front, unit.
  Vec3 right{0.0, -1.0, 0.0};   ///< Along its lower edge as the driver sees it, unit, level.
  double width_m = 0.0, height_m = 0.0;
  double radius_m = 0.0;  ///< Of a convex glass's curvature; 0: flat.

  Vec3 up() const;  ///< Along its upright edges, unit.
};

/// Mirrors of a model, the inner one first where there is one; none for whoever has none, and for a model with a
/// cockpit.
std::vector<VehicleMirror> vehicle_mirrors(const VehicleModel& model);

}  // namespace septet::scenery

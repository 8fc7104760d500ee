#include <utility>

#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/scenery/vehicles/person.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/world/limbs.hpp"

namespace septet::scenery {
namespace {

using scene::PartRole;

constexpr float middle_x = 0.10f;  ///< Position over the origin, which is below the rear foot of a step.

/// Trunk and head, facing +x; `sides` and `splits` set the level of detail.
geometry::PolygonMesh trunk(std::uint32_t sides, std::uint32_t splits) {
  geometry::MeshBuilder b;
  b.material = index_of(Finish::cloth_dark);
  add_blob(b, {middle_x, 0, 0.93f}, {0.115f, 0.165f, 0.12f}, splits > 0 ? splits - 1 : 0);
  b.material = index_of(Finish::cloth_bright);
  add_blob(b, {middle_x, 0, 1.20f}, {0.125f, 0.185f, 0.31f}, splits);
  b.material = index_of(Finish::skin);
  add_limb(b, {middle_x, 0, 1.44f}, {middle_x + 0.01f, 0, 1.54f}, 0.055f, 0.05f, sides);
  add_blob(b, {middle_x + 0.015f, 0, 1.635f}, {0.095f, 0.078f, 0.115f}, splits);
  b.material = index_of(Finish::leather);
  add_blob(b, {middle_x - 0.012f, 0, 1.665f}, {0.098f, 0.086f, 0.085f}, splits);
  return b.take();
}

/// Arm from the shoulder, a little bent.
geometry::PolygonMesh hanging_arm(float side, std::uint32_t sides) {
  geometry::MeshBuilder b;
  b.material = index_of(Finish::cloth_bright);
  add_limb(b, {0, 0, 0}, {-0.03f, side * 0.05f, -0.29f}, 0.056f, 0.046f, sides);
  add_limb(b, {-0.03f, side * 0.05f, -0.29f}, {0.05f, side * 0.04f, -0.53f}, 0.046f, 0.036f, sides);
  b.material = index_of(Finish::skin);
  add_blob(b, {0.065f, side * 0.04f, -0.59f}, {0.04f, 0.03f, 0.06f}, 0);
  return b.take();
}

}  // namespace

VehicleParts pedestrian_parts(const VehicleModel& model) {
  VehicleParts parts;
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle}) {
    const std::uint32_t sides = level == DetailLevel::near ? 8 : 5, splits = level == DetailLevel::near ? 2 : 1;
    VehicleParts of_level{{"person", trunk(sides, splits), 0, {Placement{}}}};
    add_legs(of_level, PartRole::leg_left, {middle_x, 0, static_cast<float>(hip_height_m)}, sides);
    for (const float side : {1.0f, -1.0f}) {
      Placement place;
      place.parent_from_object.position_m = Vec3(middle_x, side * 0.19f, shoulder_height_m);
      place.role = side > 0 ? PartRole::arm_left : PartRole::arm_right;
      of_level.push_back({side > 0 ? "arm left" : "arm right", hanging_arm(side, sides), 0, {place}});
    }
    add_level(parts, std::move(of_level), level);
  }
  geometry::MeshBuilder b;
  b.material = index_of(Finish::cloth_dark);
  add_limb(b, {0.1f, 0, 0.06f}, {0.1f, 0, 0.9f}, 0.09f, 0.15f, 5);
  b.material = index_of(Finish::cloth_bright);
  add_limb(b, {0.1f, 0, 0.9f}, {0.1f, 0, 1.42f}, 0.16f, 0.19f, 5);
  b.material = index_of(Finish::skin);
  add_blob(b, {0.1f, 0, static_cast<float>(model.height_m) - 0.12f}, {0.10f, 0.09f, 0.12f}, 0);
  add_level(parts, {{"person", b.take(), 0, {Placement{}}}}, DetailLevel::far);
  return parts;
}

}  // namespace septet::scenery

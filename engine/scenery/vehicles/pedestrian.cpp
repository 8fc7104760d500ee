#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {
namespace {

/// Somebody in mid step, facing +x; `sides` and `splits` set the level of detail.
geometry::PolygonMesh walking_person(float height, std::uint32_t sides, std::uint32_t splits) {
  geometry::MeshBuilder b;
  const float h = height / 1.75f;
  const float x0 = 0.10f;  // The body's middle: the origin is below the rear foot.
  const auto p = [&](float x, float y, float z) { return glm::vec3(x0 + x * h, y * h, z * h); };
  b.material = index_of(Finish::cloth_dark);
  for (const float side : {1.0f, -1.0f}) {
    const float stride = side * 0.16f;
    add_limb(b, p(0, side * 0.09f, 0.90f), p(stride * 0.55f, side * 0.09f, 0.50f), 0.085f * h, 0.062f * h, sides);
    add_limb(b, p(stride * 0.55f, side * 0.09f, 0.50f), p(stride - 0.04f, side * 0.085f, 0.10f), 0.062f * h, 0.045f * h,
             sides);
  }
  b.material = index_of(Finish::leather);
  for (const float side : {1.0f, -1.0f})
    add_blob(b, p(side * 0.16f + 0.03f, side * 0.085f, 0.045f), glm::vec3(0.13f, 0.05f, 0.05f) * h, 0);
  b.material = index_of(Finish::cloth_bright);
  add_blob(b, p(0, 0, 1.18f), glm::vec3(0.13f, 0.20f, 0.33f) * h, splits);
  for (const float side : {1.0f, -1.0f}) {
    const float swing = -side * 0.13f;
    add_limb(b, p(0, side * 0.20f, 1.40f), p(swing * 0.5f, side * 0.26f, 1.13f), 0.058f * h, 0.048f * h, sides);
    add_limb(b, p(swing * 0.5f, side * 0.26f, 1.13f), p(swing + 0.06f, side * 0.25f, 0.90f), 0.048f * h, 0.036f * h,
             sides);
  }
  b.material = index_of(Finish::skin);
  add_limb(b, p(0, 0, 1.44f), p(0.01f, 0, 1.54f), 0.055f * h, 0.05f * h, sides);
  add_blob(b, p(0.015f, 0, 1.635f), glm::vec3(0.095f, 0.078f, 0.115f) * h, splits);
  b.material = index_of(Finish::leather);
  add_blob(b, p(-0.012f, 0, 1.665f), glm::vec3(0.098f, 0.086f, 0.085f) * h, splits);
  return b.take();
}

}  // namespace

VehicleParts pedestrian_parts(const VehicleModel& model) {
  VehicleParts parts;
  const auto height = static_cast<float>(model.height_m);
  parts.push_back({"person near", walking_person(height, 8, 2), 0, {Placement{}}});
  set_detail(parts.back(), DetailLevel::near);
  parts.push_back({"person middle", walking_person(height, 5, 1), 0, {Placement{}}});
  set_detail(parts.back(), DetailLevel::middle);
  geometry::MeshBuilder b;
  b.material = index_of(Finish::cloth_dark);
  add_limb(b, {0.1f, 0, 0.06f}, {0.1f, 0, 0.9f}, 0.09f, 0.15f, 5);
  b.material = index_of(Finish::cloth_bright);
  add_limb(b, {0.1f, 0, 0.9f}, {0.1f, 0, 1.42f}, 0.16f, 0.19f, 5);
  b.material = index_of(Finish::skin);
  add_blob(b, {0.1f, 0, height - 0.12f}, {0.10f, 0.09f, 0.12f}, 0);
  parts.push_back({"person far", b.take(), 0, {Placement{}}});
  set_detail(parts.back(), DetailLevel::far);
  return parts;
}

}  // namespace septet::scenery

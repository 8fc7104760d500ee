#include <array>
#include <utility>

#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/garment.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/scenery/vehicles/person.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/world/limbs.hpp"

namespace septet::scenery {
namespace {

using scene::PartRole;

constexpr float middle_x = 0.10f;  ///< Position over the origin, which is below the rear foot of a step.

constexpr float hem_m = 0.83f;

/// A jacket with its opening in front, from the hem to the collar.
void add_jacket(geometry::MeshBuilder& b, std::uint32_t sides) {
  b.material = index_of(Finish::cloth);
  const std::array<GarmentRing, 9> rings{{{{middle_x, 0, hem_m}, 0.142f, 0.194f, 0.008f},
                                          {{middle_x, 0, 0.91f}, 0.134f, 0.186f, 0.006f},
                                          {{middle_x + 0.005f, 0, 1.02f}, 0.117f, 0.158f, 0.008f},
                                          {{middle_x + 0.01f, 0, 1.08f}, 0.121f, 0.162f, 0.003f},
                                          {{middle_x + 0.005f, 0, 1.22f}, 0.124f, 0.176f, 0.004f},
                                          {{middle_x - 0.005f, 0, 1.34f}, 0.112f, 0.190f, 0.002f},
                                          {{middle_x - 0.01f, 0, 1.41f}, 0.088f, 0.168f},
                                          {{middle_x - 0.005f, 0, 1.455f}, 0.070f, 0.092f},
                                          {{middle_x, 0, 1.49f}, 0.068f, 0.066f}}};
  add_garment(b, rings, 2 * sides, 5);
  if (sides < 6) return;
  b.material = index_of(Finish::trim);
  add_limb(b, {middle_x + 0.140f, 0.01f, hem_m + 0.01f}, {middle_x + 0.122f, 0.01f, 1.18f}, 0.011f, 0.011f, 4);
  add_limb(b, {middle_x + 0.122f, 0.01f, 1.18f}, {middle_x + 0.076f, 0.01f, 1.42f}, 0.011f, 0.011f, 4);
}

/// A head with its neck: skull and jaw, nose, ears, eyes, hair.
void add_head(geometry::MeshBuilder& b, std::uint32_t sides, std::uint32_t splits) {
  constexpr float x = middle_x + 0.012f;
  b.material = index_of(Finish::skin);
  add_limb(b, {middle_x - 0.012f, 0, 1.43f}, {x - 0.008f, 0, 1.56f}, 0.058f, 0.052f, sides);
  add_blob(b, {x, 0, 1.652f}, {0.090f, 0.073f, 0.092f}, splits);
  add_blob(b, {x + 0.026f, 0, 1.592f}, {0.062f, 0.054f, 0.070f}, splits - 1);
  if (splits > 1) {
    add_limb(b, {x + 0.084f, 0, 1.655f}, {x + 0.102f, 0, 1.622f}, 0.009f, 0.014f, 6);
    for (const float side : {1.0f, -1.0f})
      add_blob(b, {x - 0.008f, side * 0.073f, 1.635f}, {0.020f, 0.010f, 0.031f}, 1);
    b.material = index_of(Finish::trim);
    for (const float side : {1.0f, -1.0f}) {
      add_blob(b, {x + 0.081f, side * 0.031f, 1.656f}, {0.008f, 0.013f, 0.006f}, 0);
      add_blob(b, {x + 0.080f, side * 0.031f, 1.674f}, {0.010f, 0.018f, 0.004f}, 0);
    }
  }
  b.material = index_of(Finish::hair);
  add_blob(b, {x - 0.018f, 0, 1.676f}, {0.086f, 0.080f, 0.076f}, splits);
  add_blob(b, {x - 0.042f, 0, 1.630f}, {0.058f, 0.072f, 0.070f}, splits - 1);
}

/// What rises and falls with the hips: trunk and head, facing +x. `sides` and `splits` set the level of detail.
geometry::PolygonMesh trunk(std::uint32_t sides, std::uint32_t splits) {
  geometry::MeshBuilder b;
  b.material = index_of(Finish::cloth_dark);
  add_blob(b, {middle_x, 0, 0.89f}, {0.112f, 0.158f, 0.12f}, splits > 0 ? splits - 1 : 0);
  add_jacket(b, sides);
  add_head(b, sides, splits);
  return b.take();
}

/// Hand that hangs from the wrist, its palm to the thigh: the fingers a little curled, the thumb ahead.
void add_hand(geometry::MeshBuilder& b, const glm::vec3& wrist, float side, bool fingers) {
  b.material = index_of(Finish::skin);
  if (!fingers) {
    add_blob(b, wrist + glm::vec3(0.012f, -side * 0.004f, -0.075f), {0.040f, 0.018f, 0.10f}, 0);
    return;
  }
  add_limb(b, wrist + glm::vec3(-0.004f, 0, 0.03f), wrist + glm::vec3(0.002f, 0, -0.02f), 0.024f, 0.024f, 6);
  add_blob(b, wrist + glm::vec3(0.008f, 0, -0.058f), {0.042f, 0.017f, 0.052f}, 1);
  for (int i = 0; i < 4; ++i) {
    const float x = -0.022f + 0.0195f * static_cast<float>(i), length = i == 0 ? 0.8f : i == 3 ? 0.92f : 1.0f;
    const glm::vec3 knuckle = wrist + glm::vec3(x, 0, -0.096f);
    const glm::vec3 middle = knuckle + glm::vec3(0.006f, -side * 0.006f, -0.042f * length);
    add_limb(b, knuckle, middle, 0.0095f, 0.009f, 5);
    add_limb(b, middle, middle + glm::vec3(0.010f, -side * 0.016f, -0.032f * length), 0.009f, 0.0075f, 5);
  }
  const glm::vec3 root = wrist + glm::vec3(0.036f, -side * 0.006f, -0.032f);
  add_limb(b, root, root + glm::vec3(0.022f, -side * 0.010f, -0.052f), 0.013f, 0.010f, 5);
}

/// Arm in its sleeve, from the shoulder, a little bent.
geometry::PolygonMesh hanging_arm(float side, std::uint32_t sides, bool fingers) {
  geometry::MeshBuilder b;
  b.material = index_of(Finish::cloth);
  const float out = side * 0.045f;
  const std::array<GarmentRing, 8> sleeve{{{{0.045f, out, -0.545f}, 0.041f, 0.038f, 0.003f},
                                           {{0.035f, out, -0.51f}, 0.043f, 0.040f, 0.004f},
                                           {{0.005f, out, -0.41f}, 0.047f, 0.044f, 0.002f},
                                           {{-0.018f, out, -0.33f}, 0.053f, 0.048f, 0.005f},
                                           {{-0.024f, out, -0.27f}, 0.052f, 0.048f, 0.005f},
                                           {{-0.010f, 0.6f * out, -0.14f}, 0.058f, 0.053f, 0.002f},
                                           {{0, 0, -0.02f}, 0.068f, 0.060f, 0.002f},
                                           {{0, -0.5f * out, 0.045f}, 0.045f, 0.040f}}};
  add_garment(b, sleeve, sides + 2, 3);
  add_hand(b, {0.047f, out, -0.56f}, side, fingers);
  return b.take();
}

}  // namespace

VehicleParts pedestrian_parts(const VehicleModel& model) {
  VehicleParts parts;
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle}) {
    const std::uint32_t sides = level == DetailLevel::near ? 8 : 3, splits = level == DetailLevel::near ? 2 : 1;
    Placement hips;
    hips.role = PartRole::trunk;
    VehicleParts of_level{{"person", trunk(sides, splits), 0, {hips}}};
    add_walking_legs(of_level, {middle_x, 0, static_cast<float>(hip_height_m)}, sides);
    for (const float side : {1.0f, -1.0f}) {
      Placement place;
      place.parent_from_object.position_m = Vec3(middle_x - 0.005f, side * 0.195f, shoulder_height_m - 0.02);
      place.role = side > 0 ? PartRole::arm_left : PartRole::arm_right;
      of_level.push_back(
          {side > 0 ? "arm left" : "arm right", hanging_arm(side, sides, level == DetailLevel::near), 0, {place}});
    }
    add_level(parts, std::move(of_level), level);
  }
  geometry::MeshBuilder b;
  b.material = index_of(Finish::cloth_dark);
  add_limb(b, {0.1f, 0, 0.06f}, {0.1f, 0, 0.9f}, 0.09f, 0.15f, 5);
  b.material = index_of(Finish::cloth);
  add_limb(b, {0.1f, 0, 0.9f}, {0.1f, 0, 1.42f}, 0.16f, 0.19f, 5);
  b.material = index_of(Finish::skin);
  add_blob(b, {0.1f, 0, static_cast<float>(model.height_m) - 0.12f}, {0.10f, 0.09f, 0.12f}, 0);
  add_level(parts, {{"person", b.take(), 0, {Placement{}}}}, DetailLevel::far);
  return parts;
}

}  // namespace septet::scenery

#include "engine/scenery/vehicles/person.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/garment.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/world/limbs.hpp"

namespace septet::scenery {
namespace {

constexpr float thigh = static_cast<float>(thigh_m), shin = static_cast<float>(shin_m);

}  // namespace

geometry::PolygonMesh hanging_thigh(std::uint32_t sides) {
  geometry::MeshBuilder b;
  b.material = index_of(Finish::cloth_dark);
  const std::array<GarmentRing, 5> leg{{{{0, 0, -thigh - 0.035f}, 0.045f, 0.045f},
                                        {{0, 0, -thigh}, 0.066f, 0.064f, 0.004f},
                                        {{0, 0, -0.62f * thigh}, 0.074f, 0.072f, 0.002f},
                                        {{0, 0, -0.2f * thigh}, 0.090f, 0.082f, 0.003f},
                                        {{-0.01f, 0, 0.06f}, 0.086f, 0.068f}}};
  add_garment(b, leg, sides + 2, 3);
  return b.take();
}

geometry::PolygonMesh hanging_shin(std::uint32_t sides) {
  geometry::MeshBuilder b;
  b.material = index_of(Finish::cloth_dark);
  const std::array<GarmentRing, 6> leg{{{{0.005f, 0, -shin - 0.015f}, 0.064f, 0.056f, 0.006f},
                                        {{0, 0, -0.9f * shin}, 0.056f, 0.052f, 0.006f},
                                        {{-0.005f, 0, -0.6f * shin}, 0.061f, 0.056f, 0.002f},
                                        {{-0.008f, 0, -0.25f * shin}, 0.066f, 0.060f, 0.003f},
                                        {{0, 0, 0}, 0.063f, 0.061f, 0.003f},
                                        {{0.0f, 0, 0.04f}, 0.040f, 0.040f}}};
  add_garment(b, leg, sides + 2, 4);
  return b.take();
}

geometry::PolygonMesh shoe(std::uint32_t sides) {
  const std::uint32_t splits = sides > 5 ? 1 : 0;
  geometry::MeshBuilder b;
  b.material = index_of(Finish::leather);
  constexpr float under = static_cast<float>(ankle_height_m), heel = static_cast<float>(heel_behind_m),
                  toe = static_cast<float>(toe_ahead_m);
  add_blob(b, {-0.015f, 0, -0.025f}, {0.062f, 0.043f, 0.06f}, splits);
  add_blob(b, {0.065f, 0, -0.052f}, {0.108f, 0.047f, 0.035f}, splits);
  add_box(b, Finish::trim, {-heel - 0.012f, -0.042f, -under}, {toe + 0.015f, 0.042f, -under + 0.022f},
          splits > 0 ? 0.012f : 0.0f);
  return b.take();
}

geometry::PolygonMesh sitting_person(std::uint32_t splits) {
  geometry::MeshBuilder b;
  b.material = index_of(Finish::skin);
  add_blob(b, {0.0f, 0, 0.0f}, {0.095f, 0.076f, 0.115f}, splits);
  add_limb(b, {-0.02f, 0, -0.20f}, {-0.01f, 0, -0.09f}, 0.055f, 0.05f, 6);
  b.material = index_of(Finish::leather);
  add_blob(b, {-0.025f, 0, 0.035f}, {0.096f, 0.086f, 0.092f}, 0);
  b.material = index_of(Finish::cloth_bright);
  add_blob(b, {-0.05f, 0, -0.42f}, {0.14f, 0.225f, 0.25f}, 0);
  return b.take();
}

geometry::PolygonMesh seat_back() {
  geometry::MeshBuilder b;
  add_box(b, Finish::trim, {-0.20f, -0.25f, -0.75f}, {-0.11f, 0.25f, -0.13f});
  add_box(b, Finish::trim, {-0.19f, -0.12f, -0.12f}, {-0.12f, 0.12f, 0.08f});
  return b.take();
}

VehicleParts seated_people(std::span<const SeatPlace> places) {
  const geometry::PolygonMesh person = sitting_person(1), back = seat_back();
  geometry::MeshBuilder people, backs;
  int number = 0;
  for (const SeatPlace& place : places) {
    const glm::mat4 to = glm::translate(glm::mat4(1.0f), place.head_m);
    backs.append(back, to);
    if (!place.taken) continue;
    geometry::PolygonMesh one = person;
    if (++number % 2 == 0)  // Alternating clothes.
      std::ranges::replace(one.polygon_materials, index_of(Finish::cloth_bright), index_of(Finish::cloth_dark));
    people.append(one, to);
  }
  Placement placement;
  placement.casts_shadow = false;
  return {{"people", people.take(), 0, {placement}}, {"seats", backs.take(), 0, {placement}}};
}

namespace {

void add_both(VehicleParts& parts, const char* name, const geometry::PolygonMesh& mesh, const glm::vec3& hips_m,
              scene::PartRole left) {
  for (const int side : {0, 1}) {
    Placement place;
    place.parent_from_object.position_m = Vec3(hips_m.x, hips_m.y + (side == 0 ? 0.09f : -0.09f), hips_m.z);
    place.role = static_cast<scene::PartRole>(static_cast<int>(left) + side);
    parts.push_back({std::string(name) + (side == 0 ? " left" : " right"), mesh, 0, {place}});
  }
}

}  // namespace

void add_walking_legs(VehicleParts& parts, const glm::vec3& hips_m, std::uint32_t sides) {
  add_both(parts, "leg", hanging_thigh(sides), hips_m, scene::PartRole::leg_left);
  add_both(parts, "shin", hanging_shin(sides), hips_m, scene::PartRole::shin_left);
  add_both(parts, "foot", shoe(sides), hips_m, scene::PartRole::foot_left);
}

void add_pedalling_legs(VehicleParts& parts, const glm::vec3& hips_m, std::uint32_t sides) {
  add_both(parts, "leg", hanging_thigh(sides), hips_m, scene::PartRole::pedalling_leg_left);
  geometry::MeshBuilder shin_and_shoe;
  shin_and_shoe.append(hanging_shin(sides));
  shin_and_shoe.append(shoe(sides), glm::translate(glm::mat4(1.0f), {0, 0, -shin}));
  add_both(parts, "shin", shin_and_shoe.take(), hips_m, scene::PartRole::pedalling_shin_left);
}

}  // namespace septet::scenery

#include "engine/scenery/vehicles/person.hpp"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/world/limbs.hpp"

namespace septet::scenery {
namespace {

constexpr float thigh = static_cast<float>(thigh_m), shin = static_cast<float>(shin_m);

}  // namespace

geometry::PolygonMesh hanging_thigh(std::uint32_t sides) {
  geometry::MeshBuilder b;
  b.material = index_of(Finish::cloth_dark);
  add_limb(b, {0, 0, 0}, {0, 0, -thigh}, 0.085f, 0.062f, sides);
  return b.take();
}

geometry::PolygonMesh hanging_shin(std::uint32_t sides) {
  geometry::MeshBuilder b;
  b.material = index_of(Finish::cloth_dark);
  add_limb(b, {0, 0, 0}, {0, 0, -shin}, 0.062f, 0.045f, sides);
  b.material = index_of(Finish::leather);
  add_blob(b, {0.055f, 0, -shin - 0.03f}, {0.13f, 0.05f, 0.045f}, 0);
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

void add_legs(VehicleParts& parts, scene::PartRole first, const glm::vec3& hips_m, std::uint32_t sides) {
  const auto add = [&](const char* name, const geometry::PolygonMesh& mesh, int role, float side) {
    Placement place;
    place.parent_from_object.position_m = Vec3(hips_m.x, hips_m.y + side * 0.09f, hips_m.z);
    place.role = static_cast<scene::PartRole>(static_cast<int>(first) + role);
    parts.push_back({name, mesh, 0, {place}});
  };
  add("leg left", hanging_thigh(sides), 0, 1.0f);
  add("leg right", hanging_thigh(sides), 1, -1.0f);
  add("shin left", hanging_shin(sides), 2, 1.0f);
  add("shin right", hanging_shin(sides), 3, -1.0f);
}

}  // namespace septet::scenery

#include "engine/scenery/vehicles/person.hpp"

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

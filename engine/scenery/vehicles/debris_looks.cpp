#include "engine/scenery/vehicles/debris_looks.hpp"

#include <array>
#include <string>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/palette.hpp"

namespace septet::scenery {
namespace {

struct DebrisLook {
  const char* name;
  glm::vec3 color;  ///< Linear Rec. 709.
  float roughness;
  float metallic = 0.0f;
  float refraction_index = 1.5f;
};

// Crazed glass and ice with air in it scatter light: both look white rather than clear.
constexpr std::array<DebrisLook, 9> known_looks{{
    {"steel-sheet", {0.42f, 0.43f, 0.44f}, 0.35f, 0.9f},
    {"door", {0.20f, 0.22f, 0.25f}, 0.30f, 0.2f},
    {"bumper-plastic", {0.030f, 0.030f, 0.032f}, 0.50f},
    {"lamp", {0.55f, 0.52f, 0.48f}, 0.12f},
    {"glass", {0.50f, 0.60f, 0.58f}, 0.10f},
    {"ice", {0.66f, 0.76f, 0.82f}, 0.22f, 0.0f, 1.31f},
    {"rubber", {0.020f, 0.020f, 0.020f}, 0.85f},
    {"concrete", {0.42f, 0.41f, 0.39f}, 0.90f},
    {"traffic-cone", {0.85f, 0.16f, 0.02f}, 0.55f},
}};

}  // namespace

void build_debris_looks(scene::SceneBuilder& builder) {
  for (const DebrisLook& look : known_looks) {
    scene::MaterialParameters material;
    material.base_color = look.color;
    material.roughness = look.roughness;
    material.metallic = look.metallic;
    material.refraction_index = look.refraction_index;
    const std::string name = std::string("debris/") + look.name;
    const Palette palette{builder.add_material(name, material)};
    geometry::MeshBuilder plate;
    plate.patch({0, 0, 0}, {0.1f, 0, 0}, {0.1f, 0.1f, 0}, {0, 0.1f, 0});
    place(builder, name, add_shape(builder, name, plate.take(), palette), {}, builder.add_prototype(name));
  }
}

}  // namespace septet::scenery

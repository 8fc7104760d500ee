#include "engine/scenery/vehicles/cockpit_finish.hpp"

#include <array>
#include <string>

#include "engine/scenery/vehicles/dial_faces.hpp"

namespace septet::scenery {
namespace {

struct InsideLook {
  const char* name;
  glm::vec3 color;  ///< Linear Rec. 709.
  float roughness;
  /// Share of the sky's light that comes through the windows to the material's usual place: computed by the ray tracer
  /// (tests/images/cabin_slow_test.cpp).
  float ambient_share;
  float metallic = 0.0f;
  float glow = 0.0f;  ///< Emission, as a factor of the picture's own colours.
};

/// Looks in the order of CockpitFinish.
constexpr std::array<InsideLook, 14> inside_looks{{
    {"paint", {0.85f, 0.85f, 0.85f}, 0.28f, 1.0f},
    {"soft", {0.060f, 0.060f, 0.062f}, 0.95f, 0.55f},
    {"panel", {0.19f, 0.165f, 0.135f}, 0.9f, 0.25f},
    {"lining", {0.30f, 0.28f, 0.25f}, 0.95f, 0.55f},
    {"leather", {0.055f, 0.050f, 0.047f}, 0.62f, 0.25f},
    {"skin", {0.55f, 0.34f, 0.25f}, 0.7f, 0.25f},
    {"cloth", {0.10f, 0.13f, 0.19f}, 0.95f, 0.25f},
    {"gloss", {0.012f, 0.012f, 0.014f}, 0.3f, 0.2f},
    {"metal", {0.34f, 0.34f, 0.35f}, 0.45f, 0.2f, 0.6f},
    {"rubber", {0.014f, 0.014f, 0.014f}, 0.9f, 0.2f},
    {"dial faces", {0.75f, 0.75f, 0.75f}, 0.9f, 0.15f, 0.0f, 0.42f},
    {"signs", {0.60f, 0.60f, 0.60f}, 0.9f, 0.3f, 0.0f, 0.80f},
    {"water", {0.62f, 0.64f, 0.66f}, 0.3f, 1.0f},
    {"carpet", {0.06f, 0.06f, 0.065f}, 0.95f, 0.05f},
}};

}  // namespace

Palette add_cockpit_finishes(scene::SceneBuilder& builder) {
  Palette palette;
  for (std::uint32_t i = 0; i < inside_looks.size(); ++i) {
    const InsideLook& look = inside_looks[i];
    scene::MaterialParameters material;
    material.base_color = look.color;
    material.roughness = look.roughness;
    material.metallic = look.metallic;
    material.ambient_share = look.ambient_share;
    material.emission = glm::vec3(look.glow);
    if (i == index_of(CockpitFinish::water)) {
      material.opacity = 0.65f;
      material.refraction_index = 1.33f;
    }
    material.takes_paint = i == index_of(CockpitFinish::paint);
    const std::string name = std::string("cockpit/") + look.name;
    const auto with_image = [&](const image::Image& picture) {
      material.base_color_bitmap = builder.add_bitmap(name, picture.width, picture.height, picture.rgba);
      scene::shine_by_picture(material);
    };
    if (i == index_of(CockpitFinish::dial_faces)) with_image(dial_faces_image());
    if (i == index_of(CockpitFinish::signs)) with_image(signs_image());
    palette.push_back(builder.add_material(name, material));
  }
  return palette;
}

}  // namespace septet::scenery

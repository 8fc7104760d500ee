#include "engine/scenery/world_finish.hpp"

#include <array>
#include <string>

#include "engine/scenery/lettering.hpp"
#include "engine/scenery/textures.hpp"

namespace septet::scenery {
namespace {

enum class Texture { none, asphalt, ground, concrete, leaf, needle, tree, edge, facade, exit };

struct Look {
  const char* name;
  glm::vec3 color;  ///< Linear; times the texture's mean.
  Texture texture;
  float roughness = 0.9f;
  float metallic = 0.0f;
  glm::vec3 emission{0.0f};
};

/// In the order of Ground. The textures' linear means: asphalt 0.11, ground 0.55, concrete 0.56.
constexpr std::array<Look, 43> looks{{
    {"asphalt", {0.98f, 0.98f, 1.0f}, Texture::asphalt},
    {"asphalt fresh", {0.74f, 0.74f, 0.76f}, Texture::asphalt},
    {"asphalt old", {1.16f, 1.14f, 1.10f}, Texture::asphalt},
    {"asphalt tunnel", {0.95f, 0.95f, 0.95f}, Texture::asphalt},
    {"repair", {0.52f, 0.52f, 0.54f}, Texture::asphalt},
    {"mark", {0.72f, 0.72f, 0.70f}, Texture::none, 0.75f},
    {"mark far", {0.33f, 0.33f, 0.33f}, Texture::none, 0.75f},
    {"mark tunnel", {0.72f, 0.72f, 0.70f}, Texture::none, 0.75f},
    {"concrete", {0.56f, 0.55f, 0.53f}, Texture::concrete},
    {"concrete dark", {0.34f, 0.34f, 0.33f}, Texture::concrete},
    {"concrete tunnel", {0.42f, 0.42f, 0.42f}, Texture::concrete},
    {"tiles tunnel", {1.05f, 1.05f, 1.02f}, Texture::concrete},
    {"lamp tunnel", {0.9f, 0.9f, 0.9f}, Texture::none, 0.5f, 0.0f, {3.4f, 3.1f, 2.5f}},
    {"exit sign", {0.9f, 0.9f, 0.9f}, Texture::exit, 0.7f, 0.0f, {1.3f, 1.3f, 1.3f}},
    {"metal", {0.46f, 0.47f, 0.48f}, Texture::none, 0.62f},
    {"metal dark", {0.20f, 0.21f, 0.22f}, Texture::none, 0.65f},
    {"reflector", {0.75f, 0.75f, 0.72f}, Texture::none, 0.5f},
    {"post", {0.68f, 0.68f, 0.66f}, Texture::none, 0.7f},
    {"verge", {0.27f, 0.30f, 0.105f}, Texture::ground},
    {"gravel", {0.34f, 0.32f, 0.28f}, Texture::ground},
    {"meadow", {0.20f, 0.29f, 0.085f}, Texture::ground},
    {"pasture", {0.17f, 0.265f, 0.07f}, Texture::ground},
    {"wheat", {0.52f, 0.42f, 0.17f}, Texture::ground},
    {"rape", {0.55f, 0.49f, 0.06f}, Texture::ground},
    {"soil", {0.24f, 0.165f, 0.105f}, Texture::ground},
    {"crop", {0.24f, 0.34f, 0.10f}, Texture::ground},
    {"wood floor", {0.10f, 0.115f, 0.05f}, Texture::ground},
    {"canopy", {0.42f, 0.46f, 0.36f}, Texture::leaf},
    {"wood edge", {0.80f, 0.85f, 0.75f}, Texture::edge},
    {"leaves oak", {0.72f, 0.74f, 0.62f}, Texture::leaf},
    {"leaves birch", {0.95f, 0.95f, 0.72f}, Texture::leaf},
    {"needles", {0.85f, 0.92f, 0.85f}, Texture::needle},
    {"crown core", {0.035f, 0.050f, 0.020f}, Texture::none},
    {"bark", {0.085f, 0.065f, 0.050f}, Texture::none},
    {"bark birch", {0.50f, 0.48f, 0.44f}, Texture::none},
    {"trees", {0.85f, 0.88f, 0.78f}, Texture::tree},
    {"noise wall", {0.30f, 0.36f, 0.24f}, Texture::concrete},
    {"water", {0.035f, 0.055f, 0.060f}, Texture::none, 0.08f},
    {"facade red", {0.52f, 0.095f, 0.060f}, Texture::facade},
    {"facade white", {0.82f, 0.80f, 0.72f}, Texture::facade},
    {"roof tiles", {0.34f, 0.13f, 0.080f}, Texture::none},
    {"roof dark", {0.085f, 0.085f, 0.090f}, Texture::none},
    {"planks", {0.30f, 0.055f, 0.040f}, Texture::none},
}};

image::Image exit_sign_texture() {
  image::Image sign(128, 64, {10, 130, 70});
  const Lettering bold(image::FontStyle::bold);
  bold.centred(sign, 64, 30, "EXIT", 26, {250, 255, 250});
  bold.centred(sign, 64, 56, "◀ 150 m", 20, {250, 255, 250});
  return sign;
}

}  // namespace

Palette add_world_finishes(scene::SceneBuilder& builder, std::uint64_t seed) {
  std::array<scene::NodeId, 10> bitmaps;
  bitmaps.fill(scene::no_node);
  const auto add = [&](Texture texture, const char* name, const image::Image& image) {
    bitmaps[static_cast<std::size_t>(texture)] =
        builder.add_bitmap(name, image.width, image.height, image.rgba);
  };
  add(Texture::asphalt, "asphalt", asphalt_texture(seed));
  add(Texture::ground, "ground", ground_texture(seed + 10));
  add(Texture::concrete, "concrete", concrete_texture(seed + 20));
  add(Texture::leaf, "leaves", leaf_texture(seed + 30));
  add(Texture::needle, "needles", needle_texture(seed + 40));
  add(Texture::tree, "trees", tree_picture_texture(seed + 50));
  add(Texture::edge, "wood edge", wood_edge_texture(seed + 60));
  add(Texture::facade, "facade", facade_texture(seed + 70));
  add(Texture::exit, "exit sign", exit_sign_texture());
  Palette palette;
  for (std::uint32_t i = 0; i < looks.size(); ++i) {
    const Look& look = looks[i];
    scene::MaterialParameters material;
    material.base_color = look.color;
    material.base_color_bitmap = bitmaps[static_cast<std::size_t>(look.texture)];
    material.roughness = look.roughness;
    material.metallic = look.metallic;
    material.emission = look.emission;
    material.wettable = i <= index_of(Ground::mark_far);
    palette.push_back(builder.add_material(std::string("world/") + look.name, material));
  }
  return palette;
}

}  // namespace septet::scenery

#include "engine/scenery/world/world_finish.hpp"

#include <array>
#include <cmath>
#include <string>

#include "engine/image/draw.hpp"
#include "engine/image/srgb.hpp"
#include "engine/scenery/lettering.hpp"
#include "engine/scenery/world/facades.hpp"
#include "engine/scenery/world/textures.hpp"

namespace septet::scenery {
namespace {

enum class Texture {
  none,
  asphalt,
  ground,
  concrete,
  leaf,
  needle,
  tree,
  edge,
  facade,
  exit,
  palette,
  asphalt_plain,
  paving,
  plaster,
  brick,
  bakery,
  chemist,
  cafe,
  flowers
};

struct WorldLook {
  const char* name;
  glm::vec3 color;  ///< Linear factor of the texture's mean.
  Texture texture;
  float roughness = 0.9f;
  float metallic = 0.0f;
  glm::vec3 emission{0.0f};
  float retroreflection = 0.0f;
};

/// Coefficients of retroreflection, cd per lx and m²: glass beads in white paint (EN 1436, about class R4) and sheeting
/// (EN 12899-1, class RA2).
constexpr float beads = 0.25f, sheeting = 180.0f;

/// Looks in the order of Ground. Linear means of the textures: asphalt 0.11, ground 0.55, concrete 0.56.
constexpr std::array<WorldLook, 89> ground_looks{{
    {"asphalt", {0.86f, 0.86f, 0.88f}, Texture::asphalt},
    {"asphalt fresh", {0.74f, 0.74f, 0.76f}, Texture::asphalt},
    {"asphalt old", {1.0f, 0.98f, 0.95f}, Texture::asphalt},
    {"asphalt tunnel", {0.95f, 0.95f, 0.95f}, Texture::asphalt},
    {"asphalt plain", {0.90f, 0.90f, 0.91f}, Texture::asphalt_plain},
    {"cycle path", {1.20f, 0.72f, 0.60f}, Texture::asphalt_plain},
    {"paving", {0.62f, 0.60f, 0.57f}, Texture::paving},
    {"kerb stone", {0.36f, 0.355f, 0.345f}, Texture::none},
    {"repair", {0.79f, 0.79f, 0.80f}, Texture::asphalt},
    {"repair edge", {0.83f, 0.83f, 0.84f}, Texture::asphalt},
    {"crack", {0.52f, 0.52f, 0.54f}, Texture::asphalt},
    {"mark", {0.72f, 0.72f, 0.70f}, Texture::none, 0.75f, 0.0f, {}, beads},
    {"mark tunnel", {0.72f, 0.72f, 0.70f}, Texture::none, 0.75f, 0.0f, {}, beads},
    {"paint", {0.72f, 0.72f, 0.70f}, Texture::none, 0.75f, 0.0f, {}, beads},
    {"concrete", {0.56f, 0.55f, 0.53f}, Texture::concrete},
    {"concrete dark", {0.34f, 0.34f, 0.33f}, Texture::concrete},
    {"concrete tunnel", {0.42f, 0.42f, 0.42f}, Texture::concrete},
    {"tiles tunnel", {0.98f, 0.98f, 0.95f}, Texture::concrete},
    {"lamp tunnel", {0.9f, 0.9f, 0.9f}, Texture::none, 0.5f, 0.0f, {3.4f, 3.1f, 2.5f}},
    {"exit sign", {0.9f, 0.9f, 0.9f}, Texture::exit, 0.7f, 0.0f, {1.3f, 1.3f, 1.3f}},
    {"metal", {0.46f, 0.47f, 0.48f}, Texture::none, 0.62f},
    {"metal dark", {0.20f, 0.21f, 0.22f}, Texture::none, 0.65f},
    {"lamp red", {0.10f, 0.010f, 0.008f}, Texture::none, 0.4f},
    {"lamp amber", {0.40f, 0.20f, 0.02f}, Texture::none, 0.4f, 0.0f, {3.0f, 1.3f, 0.10f}},
    {"lamp green", {0.008f, 0.055f, 0.040f}, Texture::none, 0.4f},
    {"lamp street", {0.7f, 0.7f, 0.7f}, Texture::none, 0.5f, 0.0f, {0.759f, 0.675f, 0.523f}},
    {"reflector", {0.75f, 0.75f, 0.72f}, Texture::none, 0.5f, 0.0f, {}, sheeting},
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
    {"canopy", {0.115f, 0.150f, 0.050f}, Texture::ground},
    {"wood edge", {0.80f, 0.85f, 0.75f}, Texture::edge},
    {"leaves oak", {0.72f, 0.74f, 0.62f}, Texture::leaf},
    {"leaves birch", {0.95f, 0.95f, 0.72f}, Texture::leaf},
    {"needles", {0.85f, 0.92f, 0.85f}, Texture::needle},
    {"crown core", {0.035f, 0.050f, 0.020f}, Texture::none},
    {"bark", {0.085f, 0.065f, 0.050f}, Texture::none},
    {"bark birch", {0.50f, 0.48f, 0.44f}, Texture::none},
    {"trees", {0.85f, 0.88f, 0.78f}, Texture::tree},
    {"noise wall", {0.30f, 0.36f, 0.24f}, Texture::concrete},
    {"water", {0.010f, 0.016f, 0.018f}, Texture::none, 0.08f},
    {"water shaded", {0.014f, 0.020f, 0.012f}, Texture::none, 0.35f},
    {"facade red", {0.52f, 0.095f, 0.060f}, Texture::facade},
    {"facade white", {0.82f, 0.80f, 0.72f}, Texture::facade},
    {"facade yellow", {0.72f, 0.52f, 0.25f}, Texture::facade},
    {"facade grey", {0.46f, 0.47f, 0.46f}, Texture::facade},
    {"plaster white", {0.86f, 0.84f, 0.78f}, Texture::plaster},
    {"plaster ochre", {0.80f, 0.60f, 0.32f}, Texture::plaster},
    {"plaster rose", {0.74f, 0.44f, 0.36f}, Texture::plaster},
    {"plaster green", {0.52f, 0.60f, 0.42f}, Texture::plaster},
    {"plaster blue", {0.46f, 0.55f, 0.62f}, Texture::plaster},
    {"brick red", {0.62f, 0.24f, 0.16f}, Texture::brick},
    {"brick brown", {0.42f, 0.27f, 0.19f}, Texture::brick},
    {"sandstone", {0.74f, 0.64f, 0.48f}, Texture::brick},
    {"shop bakery", {0.9f, 0.9f, 0.9f}, Texture::bakery, 0.5f},
    {"shop chemist", {0.9f, 0.9f, 0.9f}, Texture::chemist, 0.5f},
    {"shop cafe", {0.9f, 0.9f, 0.9f}, Texture::cafe, 0.5f},
    {"shop flowers", {0.9f, 0.9f, 0.9f}, Texture::flowers, 0.5f},
    {"door", {0.10f, 0.055f, 0.030f}, Texture::none, 0.6f},
    {"awning red", {0.42f, 0.040f, 0.035f}, Texture::none},
    {"awning green", {0.045f, 0.20f, 0.085f}, Texture::none},
    {"farm red", {0.52f, 0.095f, 0.060f}, Texture::facade},
    {"farm white", {0.82f, 0.80f, 0.72f}, Texture::facade},
    {"roof tiles", {0.34f, 0.13f, 0.080f}, Texture::none},
    {"roof dark", {0.085f, 0.085f, 0.090f}, Texture::none},
    {"planks", {0.30f, 0.055f, 0.040f}, Texture::none},
    {"window lit", {0.040f, 0.050f, 0.065f}, Texture::none, 0.9f, 0.0f, {0.50f, 0.36f, 0.19f}},
    // Far forms: near colour times the mean of its texture.
    {"far asphalt", {0.105f, 0.104f, 0.102f}, Texture::none},
    {"palette", {1.0f, 1.0f, 1.0f}, Texture::palette},
    {"far mark", {0.40f, 0.40f, 0.39f}, Texture::none},
    {"far mark broken", {0.19f, 0.19f, 0.188f}, Texture::none},
    {"far concrete", {0.31f, 0.305f, 0.295f}, Texture::none},
    {"far verge", {0.150f, 0.165f, 0.052f}, Texture::none},
    {"far meadow", {0.112f, 0.160f, 0.042f}, Texture::none},
    {"far pasture", {0.095f, 0.147f, 0.035f}, Texture::none},
    {"far wheat", {0.290f, 0.232f, 0.085f}, Texture::none},
    {"far rape", {0.306f, 0.270f, 0.030f}, Texture::none},
    {"far soil", {0.134f, 0.092f, 0.053f}, Texture::none},
    {"far crop", {0.134f, 0.188f, 0.050f}, Texture::none},
    {"far wood", {0.056f, 0.064f, 0.025f}, Texture::none},
    {"far canopy", {0.078f, 0.102f, 0.036f}, Texture::none},
}};

bool is_in_tunnel(Ground ground) {
  using enum Ground;
  return ground == asphalt_tunnel || ground == mark_tunnel || ground == concrete_tunnel || ground == tiles_tunnel ||
         ground == lamp_tunnel || ground == exit_sign;
}

bool is_street_wall(Ground ground) {
  using enum Ground;
  return (ground >= facade_red && ground <= shop_flowers) ||
         ground == window_lit;  // Its panes stand before the facades alone.
}

constexpr std::uint32_t first_color = index_of(Ground::palette) + 1;
constexpr std::uint32_t palette_side = 4, block_px = 16;

std::uint8_t srgb_byte(float linear) {
  return static_cast<std::uint8_t>(std::lround(255.0f * image::srgb_of_light(linear)));
}

image::Image palette_texture() {
  image::Image palette(palette_side * block_px, palette_side * block_px);
  for (std::uint32_t i = first_color; i < ground_looks.size(); ++i) {
    const std::uint32_t block = i - first_color;
    const glm::vec3 c = ground_looks[i].color;
    image::fill(palette, block % palette_side * block_px, block / palette_side * block_px, block_px, block_px,
                {srgb_byte(c.r), srgb_byte(c.g), srgb_byte(c.b)});
  }
  return palette;
}

image::Image exit_sign_texture() {
  image::Image sign(128, 64, {10, 130, 70});
  const Lettering bold(image::FontStyle::bold);
  bold.centred(sign, 64, 30, "EXIT", 26, {250, 255, 250});
  bold.centred(sign, 64, 56, "◀ 150 m", 20, {250, 255, 250});
  return sign;
}

}  // namespace

Ground far_of(Ground ground) {
  using enum Ground;
  switch (ground) {
    case verge:
      return far_verge;
    case meadow:
      return far_meadow;
    case pasture:
      return far_pasture;
    case wheat:
      return far_wheat;
    case rape:
      return far_rape;
    case soil:
      return far_soil;
    case crop:
      return far_crop;
    case wood_floor:
      return far_wood;
    default:
      return ground;
  }
}

void to_palette(geometry::PolygonMesh& mesh) {
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    std::uint32_t& material = mesh.polygon_materials[i];
    if (material < first_color) continue;
    const std::uint32_t block = material - first_color;
    const std::uint32_t column = block % palette_side, row = block / palette_side;
    const glm::vec2 uv((static_cast<float>(column) + 0.5f) / palette_side,
                       (static_cast<float>(row) + 0.5f) / palette_side);
    mesh.corner_uvs[i].fill(uv);
    material = index_of(Ground::palette);
  }
}

Palette add_world_finishes(scene::SceneBuilder& builder, std::uint64_t seed, bool towns) {
  std::array<scene::NodeId, 19> bitmaps;
  bitmaps.fill(scene::no_node);
  const auto add = [&](Texture texture, const char* name, const image::Image& image) {
    bitmaps[static_cast<std::size_t>(texture)] = builder.add_bitmap(name, image.width, image.height, image.rgba);
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
  if (towns) {
    add(Texture::asphalt_plain, "asphalt plain", plain_asphalt_texture(seed + 80));
    add(Texture::paving, "paving", paving_texture(seed + 90));
    add(Texture::plaster, "plaster", plaster_facade_texture(seed + 100));
    add(Texture::brick, "brick", brick_facade_texture(seed + 110));
    add(Texture::bakery, "bakery", shop_front_texture("BÄCKEREI", {120, 66, 30}));
    add(Texture::chemist, "chemist", shop_front_texture("APOTHEKE", {172, 30, 34}));
    add(Texture::cafe, "cafe", shop_front_texture("CAFÉ", {38, 62, 92}));
    add(Texture::flowers, "flowers", shop_front_texture("BLUMEN", {44, 96, 50}));
  }
  add(Texture::palette, "palette", palette_texture());
  Palette palette;
  for (std::uint32_t i = 0; i < ground_looks.size(); ++i) {
    if (i >= first_color) {
      palette.push_back(scene::no_node);
      continue;
    }
    const WorldLook& look = ground_looks[i];
    scene::MaterialParameters material;
    material.base_color = look.color;
    material.base_color_bitmap = bitmaps[static_cast<std::size_t>(look.texture)];
    material.roughness = look.roughness;
    material.metallic = look.metallic;
    material.emission = look.emission;
    if (look.texture != Texture::none && look.emission != glm::vec3(0.0f)) scene::shine_by_picture(material);
    material.retroreflection = look.retroreflection;
    material.wettable =
        i <= index_of(Ground::mark) || i == index_of(Ground::paint) || i == index_of(Ground::far_asphalt);
    material.stripe = i == index_of(Ground::mark) || i == index_of(Ground::mark_tunnel);
    material.lit_by_night = i == index_of(Ground::window_lit);
    material.in_street = is_street_wall(static_cast<Ground>(i));
    material.share_of_sky = is_in_tunnel(static_cast<Ground>(i)) ? 0.0f : 1.0f;
    palette.push_back(builder.add_material(std::string("world/") + look.name, material));
  }
  return palette;
}

}  // namespace septet::scenery

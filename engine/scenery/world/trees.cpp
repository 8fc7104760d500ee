#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/noise.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/roadside/plants.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::LathePoint;
using geometry::MeshBuilder;

using roadside::Tree;
using Kind = roadside::TreeKind;
using roadside::trunk_radius_m;
constexpr int kind_count = roadside::tree_kind_count;
constexpr float tree_near_m = 100.0f;
/// Distance up to which a user's own tree is drawn, then the picture of its kind.
constexpr float own_tree_m = 250.0f;

std::string_view own_name(Kind kind) {
  constexpr std::array<std::string_view, kind_count> names{"oak", "birch", "spruce", "bush"};
  return names[static_cast<std::size_t>(kind)];
}

void add_trunk(MeshBuilder& builder, Ground bark, float radius, float height) {
  builder.material = index_of(bark);
  const std::array<LathePoint, 3> profile{{{radius * 1.5f, -0.4f}, {radius, 0.8f}, {radius * 0.55f, height}}};
  builder.append(geometry::lathe(profile, 6), glm::mat4(1.0f), true);
}

/// Adds a hull of leaves, dented by noise, over a dark core that hides the background.
void add_crown(MeshBuilder& builder, Ground leaves, const glm::vec3& centre, const glm::vec3& radii,
               std::uint64_t seed) {
  geometry::PolygonMesh hull = geometry::icosphere(1);
  for (std::size_t i = 0; i < hull.vertices_m.size(); ++i) {
    const float swell =
        1.0f + 0.42f * (static_cast<float>(geometry::lattice_random(static_cast<std::int64_t>(i), 0, seed)) - 0.45f);
    hull.vertices_m[i] = centre + hull.vertices_m[i] * radii * swell;
  }
  for (auto& uvs : hull.corner_uvs)
    for (glm::vec2& uv : uvs) uv *= glm::vec2(4.0f, 2.0f);
  builder.material = index_of(leaves);
  builder.append(hull, glm::mat4(1.0f), true);
  geometry::PolygonMesh core = geometry::icosphere(0);
  for (glm::vec3& p : core.vertices_m) p = centre + p * radii * 0.78f;
  builder.material = index_of(Ground::crown_core);
  builder.append(core, glm::mat4(1.0f), true);
}

/// Natural height of each kind: trees of unit height would lose their proportions.
float height_of(Kind kind) {
  switch (kind) {
    case Kind::oak:
      return 11.0f;
    case Kind::birch:
      return 13.0f;
    case Kind::spruce:
      return 16.0f;
    case Kind::bush:
      return 2.6f;
  }
  return 10.0f;
}

geometry::PolygonMesh near_tree(Kind kind, std::uint64_t seed) {
  MeshBuilder builder;
  switch (kind) {
    case Kind::oak:
      add_trunk(builder, Ground::bark, static_cast<float>(trunk_radius_m(kind)), 6.0f);
      add_crown(builder, Ground::leaves_oak, {0.6f, 0.3f, 6.6f}, {3.9f, 3.7f, 3.2f}, seed);
      add_crown(builder, Ground::leaves_oak, {-1.0f, -0.6f, 8.6f}, {2.9f, 3.1f, 2.4f}, seed + 1);
      break;
    case Kind::birch:
      add_trunk(builder, Ground::bark_birch, static_cast<float>(trunk_radius_m(kind)), 9.0f);
      add_crown(builder, Ground::leaves_birch, {0, 0, 6.6f}, {2.3f, 2.2f, 3.2f}, seed);
      add_crown(builder, Ground::leaves_birch, {0.3f, -0.2f, 10.4f}, {1.7f, 1.6f, 2.6f}, seed + 1);
      break;
    case Kind::spruce: {
      add_trunk(builder, Ground::bark, static_cast<float>(trunk_radius_m(kind)), 5.0f);
      builder.material = index_of(Ground::needles);
      constexpr int tiers = 6, sides = 8;
      for (int i = 0; i < tiers; ++i) {
        const float share = static_cast<float>(i) / tiers;
        const float low = 1.2f + 14.0f * share, radius = 3.3f * (1.0f - share) + 0.35f;
        const std::array<LathePoint, 2> skirt{{{radius, low}, {0.12f * radius, low + 3.9f - 1.3f * share}}};
        geometry::PolygonMesh tier = geometry::lathe(skirt, sides);
        for (std::size_t k = 0; k < tier.vertices_m.size(); ++k)
          if (k < sides)
            tier.vertices_m[k] *= glm::vec3(glm::vec2(0.84f + 0.32f * static_cast<float>(geometry::lattice_random(
                                                                          static_cast<std::int64_t>(k), i, seed))),
                                            1.0f);
        for (auto& uvs : tier.corner_uvs)
          for (int c = 0; c < 4; ++c) uvs[c] = {uvs[c].x * 3.0f + share, c < 2 ? 0.98f : 0.05f};
        builder.append(tier, glm::rotate(glm::mat4(1.0f), share * 5.0f, glm::vec3(0, 0, 1)), true);
      }
      builder.material = index_of(Ground::crown_core);
      const std::array<LathePoint, 3> core{{{0.0f, 2.4f}, {1.7f, 2.6f}, {0.0f, 15.0f}}};
      builder.append(geometry::lathe(core, 6), glm::mat4(1.0f), true);
      break;
    }
    case Kind::bush:
      add_crown(builder, Ground::leaves_oak, {0, 0, 1.0f}, {1.7f, 1.5f, 1.35f}, seed);
      break;
  }
  return builder.take();
}

/// Two crossed cards with a picture of the tree.
geometry::PolygonMesh far_tree(Kind kind) {
  MeshBuilder builder;
  builder.material = index_of(Ground::tree_pictures);
  const float height = height_of(kind) * (kind == Kind::bush ? 1.0f : 1.06f);
  const float half = kind == Kind::oak ? 4.9f : kind == Kind::birch ? 3.4f : kind == Kind::spruce ? 4.0f : 2.0f;
  const float u0 = static_cast<float>(kind) / kind_count, u1 = u0 + 1.0f / kind_count;
  // Picture of the bush fills two thirds of its height.
  const float top = kind == Kind::bush ? 0.33f : 0.0f;
  const geometry::CornerUvs uvs{{{u0, 1}, {u1, 1}, {u1, top}, {u0, top}}};
  builder.patch({-half, 0, -0.2f}, {half, 0, -0.2f}, {half, 0, height}, {-half, 0, height}, uvs);
  builder.patch({0, -half, -0.2f}, {0, half, -0.2f}, {0, half, height}, {0, -half, height}, uvs);
  return builder.take();
}

/// Shapes of all kinds, and their placements.
class TreePen {
 public:
  explicit TreePen(const WorldContext& world) : world_(world) {
    for (int k = 0; k < kind_count; ++k) {
      const auto kind = static_cast<Kind>(k);
      for (int variant = 0; variant < roadside::tree_variant_count; ++variant)
        near_[k][variant] =
            add_shape(world.builder, "tree near",
                      near_tree(kind, world.seed + 100 + static_cast<std::uint64_t>(k * 10 + variant)), world.palette);
      far_[k] = add_shape(world.builder, "tree far", far_tree(kind), world.palette);
    }
  }

  void draw(const Tree& tree) {
    Placement placement;
    placement.parent_from_object = {tree.foot_m, glm::angleAxis(tree.turn_rad, Vec3(0, 0, 1))};
    placement.scale = glm::vec3(static_cast<float>(tree.size));
    const int k = static_cast<int>(tree.kind);
    placement.visible_to_m = own_tree_m;
    scene::NodeId near = scene::no_node;
    if (!world_.own.place(own_name(tree.kind), placement)) {
      placement.visible_to_m = tree.kind == Kind::bush ? 70.0f : tree_near_m;
      near = place(world_.builder, "tree", near_[k][tree.variant], placement);
      // The far one is a child: one name moves and hides the tree.
      placement.parent_from_object = {};
      placement.scale = glm::vec3(1.0f);
    }
    placement.visible_from_m = placement.visible_to_m;
    placement.visible_to_m = tree.kind == Kind::bush ? 420.0f : 1900.0f;
    placement.casts_shadow = false;
    place(world_.builder, "tree far", far_[k], placement, near);
  }

 private:
  const WorldContext& world_;
  std::array<std::array<Shape, roadside::tree_variant_count>, kind_count> near_;
  std::array<Shape, kind_count> far_;
};

}  // namespace

void build_trees(const WorldContext& world) {
  TreePen pen(world);
  for (const Tree& tree : roadside::planted_trees(world.roads, world.terrain, world.seed)) pen.draw(tree);
}

}  // namespace septet::scenery

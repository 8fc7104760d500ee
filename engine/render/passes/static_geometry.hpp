#pragma once
/// Static geometry placed once (land, pavement, walls), gathered anew for every frame into few draws.
///
/// A software device pays some 20 µs for a draw, however small, and a generated world has thousands of small meshes of
/// the same few materials. So the vertices of such meshes lie together, in blocks with one origin each, and a frame
/// copies the indices of its visible pieces into one list for each block and material. Culling and levels of detail
/// stay those of the single instance.

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "engine/render/passes/draw_list.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::render {

/// Triangles of one material; indices count from the start of their block's vertices.
struct StaticPart {
  std::uint32_t material = 0;
  std::uint32_t first_index = 0, index_count = 0;
  std::uint32_t first_clump = 0;
};

/// Box around some consecutive triangles of a part, relative to the block's origin: a view takes only the visible
/// clumps of a wide piece.
struct StaticClump {
  glm::vec3 middle_m{0.0f}, half_m{0.0f};
};
/// Number of indices of each clump but a part's last.
inline constexpr std::uint32_t clump_indices = 3 * 32;

/// One instance.
struct StaticPiece {
  PlacedMesh placed;
  std::uint32_t block = 0;
  std::uint32_t first_part = 0, part_count = 0;
};

/// Vertices around one origin, along the world's axes.
struct StaticBlock {
  Vec3 origin_m{0.0};
  std::vector<scene::SurfaceVertex> vertices;
};

struct StaticGeometry {
  std::vector<StaticBlock> blocks;
  std::vector<StaticPiece> pieces;
  std::vector<StaticPart> parts;
  std::vector<StaticClump> clumps;
  std::vector<std::uint32_t> indices;
};

/// True, by mesh, if the scene places it once and no prototype uses it.
std::vector<bool> placed_once(const scene::ResolvedScene& scene);

/// Geometry of the instances whose meshes are `chosen`, in blocks of 2 km. Parts that point outside their mesh are left
/// out.
StaticGeometry static_geometry(const scene::ResolvedScene& scene, const std::vector<bool>& chosen);

/// Indices of one draw.
struct GatheredDraw {
  std::uint32_t block = 0, group = 0;
  std::uint32_t first_index = 0, index_count = 0;
  instant::LevelFade fade{};
};

struct Gathered {
  std::vector<std::uint32_t> indices;
  std::vector<GatheredDraw> draws;  ///< Ordered by the nearest piece of each.
  std::uint32_t pieces = 0;
};

inline constexpr std::uint32_t no_group = std::numeric_limits<std::uint32_t>::max();

/// Gathers the pieces that are within their range of the eye and for which `keep` returns true, nearest first; pieces
/// that fade alike lie in draws of their own. `group_of` returns the group of a block's material (materials of one
/// group are drawn together), or no_group for materials that are not drawn. With a `volume`, clumps outside of it are
/// left out.
Gathered gather(const StaticGeometry& geometry, const Vec3& eye_m,
                const std::function<bool(const PlacedMesh&, const glm::vec3& centre_m)>& keep,
                const std::function<std::uint32_t(std::uint32_t material)>& group_of, const Detail& detail = {},
                const ViewVolume* volume = nullptr);

/// Record of a block, placed relative to the eye.
InstanceRecord record_of(const StaticBlock& block, const Vec3& eye_m, const instant::LevelFade& fade = {});

}  // namespace septet::render

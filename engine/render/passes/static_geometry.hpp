#pragma once
/// What stands still and occurs once (land, pavement, walls): gathered anew for every frame into few draws.
///
/// A software device pays some 20 µs for a draw, whatever it draws, and a generated world has thousands of small meshes of
/// the same few materials. So the vertices of such meshes lie together, in blocks with one origin each, and a frame copies
/// the indices of what it sees into one list for each block and material. Culling and levels of detail stay those of the
/// single instance.

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

/// The box around some consecutive triangles of a part, from the block's origin: of a wide piece a view takes what it may see.
struct StaticClump {
  glm::vec3 middle_m{0.0f}, half_m{0.0f};
};
/// Of each clump but a part's last.
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

/// For every mesh: does the scene place it once, and no prototype use it?
std::vector<bool> placed_once(const scene::ResolvedScene& scene);

/// The instances whose meshes `chosen` names, in blocks of 2 km. Parts that point outside their mesh are left out.
StaticGeometry static_geometry(const scene::ResolvedScene& scene, const std::vector<bool>& chosen);

/// Indices that one draw takes.
struct GatheredDraw {
  std::uint32_t block = 0, group = 0;
  std::uint32_t first_index = 0, index_count = 0;
  instant::LevelFade fade{};
};

struct Gathered {
  std::vector<std::uint32_t> indices;
  std::vector<GatheredDraw> draws;  ///< In the order of the nearest piece of each.
  std::uint32_t pieces = 0;
};

inline constexpr std::uint32_t no_group = std::numeric_limits<std::uint32_t>::max();

/// The pieces within their range of the eye that `keep` wants, nearest first; those that fade alike, in draws of their own. `group_of` says which of a block's materials
/// are drawn together, and returns no_group for those that are not drawn. With a `volume`, clumps outside of it
/// are left out.
Gathered gather(const StaticGeometry& geometry, const Vec3& eye_m,
                const std::function<bool(const PlacedMesh&, const glm::vec3& centre_m)>& keep,
                const std::function<std::uint32_t(std::uint32_t material)>& group_of, const Detail& detail = {},
                const ViewVolume* volume = nullptr);

/// Where a block lies from the eye.
InstanceRecord record_of(const StaticBlock& block, const Vec3& eye_m, const instant::LevelFade& fade = {});

}  // namespace septet::render

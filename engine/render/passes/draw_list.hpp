#pragma once
/// Which instances a view (or a shadow cascade) draws, grouped by mesh: culling on the CPU, without a device.
///
/// Positions are double in the world and become float relative to the eye. The order of batches and records is a function
/// of the scene and the eye alone.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>

#include "engine/render/frame_input.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::render {

/// What a vertex shader takes for each instance: see shaders/instances.glsl and surface.vert.
struct InstanceRecord {
  glm::vec4 row0{0.0f}, row1{0.0f}, row2{0.0f};
  glm::vec4 tint{1.0f};   ///< Paint; how much of the material's emission shines.
  glm::vec4 light{1.0f};  ///< x: share of the sky.
};
static_assert(sizeof(InstanceRecord) == 80);

/// A mesh in its place, with what culling needs.
struct PlacedMesh {
  std::uint32_t mesh = 0;
  Vec3 origin_m{0.0};               ///< World.
  glm::mat3 world_from_object{1.0f};  ///< Rotation and scale.
  glm::vec3 centre_m{0.0f};         ///< Of the bounding sphere, from the origin along the world's axes.
  float radius_m = 0.0f;
  float visible_from_m = 0.0f, visible_to_m = 1e9f;
  bool casts_shadow = true;
  bool seen = true;  ///< False: casts a shadow only.
  glm::vec4 tint{1.0f};
  float share_of_sky = 1.0f;
};

/// Bounds of a mesh in its object's frame.
struct MeshBounds {
  glm::vec3 min_m{0.0f}, max_m{0.0f};
};

/// The mesh in its place; `scale` stretches it along the object's axes.
PlacedMesh place(std::uint32_t mesh, const MeshBounds& bounds, const RigidTransform& world_from_object,
                 const glm::vec3& scale);

/// The same with the instance's scale, and seen and throwing shadows as the instance says.
PlacedMesh place(const scene::Instance& instance, const MeshBounds& bounds, const RigidTransform& world_from_object);

/// What the vertex shader takes for a mesh whose origin lies at `origin_m` from the eye.
InstanceRecord record_of(const PlacedMesh& placed, const glm::vec3& origin_m);

/// Records of one mesh that lie together.
struct Batch {
  std::uint32_t mesh = 0;
  std::uint32_t first = 0, count = 0;
  float nearest_m = 0.0f;  ///< From the eye to the nearest bounding sphere's middle, so that wide ground comes late.
};

struct DrawList {
  std::vector<InstanceRecord> records;
  std::vector<Batch> batches;
};

/// Planes of a view volume through the eye, pointing inwards: n · p ≥ 0 for points relative to the eye. The volume is open
/// far away; its near plane is left out.
using ViewVolume = std::array<glm::vec3, 4>;
ViewVolume view_volume(const FrameView& view);

/// The meshes of `placed` (ordered by mesh) that are within their range of the eye and that `keep` wants, given the centre
/// relative to the eye and the radius. Batches come in the order of their meshes. What is nearer than `least_range_m` is
/// shown in the level of detail that it has there.
void append_visible(DrawList& list, std::span<const PlacedMesh> placed, const Vec3& eye_m,
                    const std::function<bool(const PlacedMesh&, const glm::vec3& centre_m)>& keep,
                    float least_range_m = 0.0f);

bool intersects(const ViewVolume& volume, const glm::vec3& centre_m, float radius_m);

/// Nearest first, so that what lies behind is not shaded; ties keep the order of meshes.
void sort_by_distance(DrawList& list);

}  // namespace septet::render

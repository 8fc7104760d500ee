#pragma once
/// Which instances a view (or a shadow cascade) draws, grouped by mesh: culling on the CPU, without a device.
///
/// Positions are double in the world and become float relative to the eye. The order of batches and records is a function
/// of the scene and the eye alone.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "engine/instant/level_fade.hpp"
#include "engine/instant/placed_mesh.hpp"
#include "engine/instant/view.hpp"
#include "engine/light/instance_record.hpp"
#include "engine/render/words.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::render {

using light::InstanceRecord;

/// What the vertex shader takes for a mesh whose origin lies at `origin_m` from the eye.
InstanceRecord record_of(const PlacedMesh& placed, const glm::vec3& origin_m, const instant::LevelFade& fade = {});

/// Records of one mesh, or of what stands in for it, that lie together.
struct Batch {
  std::uint32_t mesh = 0;
  std::uint32_t first = 0, count = 0;
  float nearest_m = 0.0f;  ///< From the eye to the nearest bounding sphere's middle, so that wide ground comes late.
  bool fading = false;     ///< Its records show only some pixels of what they place.
  bool still = false;      ///< It belongs to the scene and stands where it stood.
  const scene::SurfaceMesh* reshaped = nullptr;
};

struct DrawList {
  std::vector<InstanceRecord> records;
  std::vector<Batch> batches;
};

/// Planes of a view volume through the eye, pointing inwards: n · p ≥ 0 for points relative to the eye. The volume is open
/// far away; its near plane is left out.
using ViewVolume = std::array<glm::vec3, 4>;
ViewVolume view_volume(const FrameView& view);

/// From how far off the level of detail is taken in which a mesh is shown.
struct Detail {
  float least_m = 0.0f;  ///< What is nearer is shown as it is there.
  float times = 1.0f;    ///< Of a coarse picture: what is further off than it is wide, as if so many times as far.
};
float detail_range_m(const PlacedMesh& placed, const glm::vec3& origin_m, const Detail& detail);

/// The meshes of `placed` (ordered by mesh) that are within their range of the eye and that `keep` wants, given the centre
/// relative to the eye and the radius. Batches come in the order of their meshes; those that give way to another level of detail, or come
/// in its place, lie in a batch of their own.
void append_visible(DrawList& list, std::span<const PlacedMesh> placed, const Vec3& eye_m,
                    const std::function<bool(const PlacedMesh&, const glm::vec3& centre_m)>& keep,
                    const Detail& detail = {}, bool still = false);

bool intersects(const ViewVolume& volume, const glm::vec3& centre_m, float radius_m);

/// Nearest first, so that what lies behind is not shaded; ties keep the order of meshes.
void sort_by_distance(DrawList& list);

}  // namespace septet::render

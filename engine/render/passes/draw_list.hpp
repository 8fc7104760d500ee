#pragma once
/// Visible instances of a view (or of a shadow cascade), grouped by mesh: culling on the CPU, without a device.
///
/// Positions are double in the world and become float relative to the eye. The order of batches and records is a
/// function of the scene and the eye alone.

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

/// Vertex-shader record of a mesh whose origin lies at `origin_m` from the eye.
InstanceRecord record_of(const PlacedMesh& placed, const glm::vec3& origin_m, const instant::LevelFade& fade = {});

/// Adjacent records of one mesh, or of the mesh that stands in for it.
struct Batch {
  std::uint32_t mesh = 0;
  std::uint32_t first = 0, count = 0;
  /// Distance from the eye to the nearest bounding sphere's middle, so that wide ground comes late.
  float nearest_m = 0.0f;
  bool fading = false;  ///< True if its records cover only some of their pixels.
  bool still = false;   ///< True for instances of the scene, which do not move.
  const scene::SurfaceMesh* reshaped = nullptr;
};

struct DrawList {
  std::vector<InstanceRecord> records;
  std::vector<Batch> batches;
};

/// Planes of a view volume through the eye, pointing inwards: n · p ≥ 0 for points relative to the eye. The volume is
/// open far away; its near plane is left out.
using ViewVolume = std::array<glm::vec3, 4>;
ViewVolume view_volume(const FrameView& view);

/// Distance at which the level of detail of a mesh is chosen.
struct Detail {
  float least_m = 0.0f;  ///< Least distance: nearer meshes take the level of this distance.
  float times = 1.0f;    ///< Factor on the distance to the bounding sphere, for coarse pictures.
};
float detail_range_m(const PlacedMesh& placed, const glm::vec3& origin_m, const Detail& detail);

/// Appends the meshes of `placed` (ordered by mesh) that are within their range of the eye and for which `keep` returns
/// true; it takes the mesh and the centre of its bounding sphere relative to the eye. Batches come in the order of
/// their meshes; records that fade into or out of another level of detail lie in a batch of their own.
void append_visible(DrawList& list, std::span<const PlacedMesh> placed, const Vec3& eye_m,
                    const std::function<bool(const PlacedMesh&, const glm::vec3& centre_m)>& keep,
                    const Detail& detail = {}, bool still = false);

bool intersects(const ViewVolume& volume, const glm::vec3& centre_m, float radius_m);

/// Sorts by distance, nearest first, so that hidden surfaces are not shaded; ties keep the order of meshes.
void sort_by_distance(DrawList& list);

}  // namespace septet::render

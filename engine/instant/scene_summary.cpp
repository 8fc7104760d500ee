#include "engine/instant/scene_summary.hpp"

#include <algorithm>

namespace septet::instant {
namespace {

MeshSummary summary_of(const scene::SurfaceMesh& mesh, const std::vector<scene::SurfaceMaterial>& materials) {
  MeshSummary summary{{mesh.bounds_min_m, mesh.bounds_max_m}};
  for (const scene::MeshPart& part : mesh.parts) {
    if (part.material >= materials.size()) continue;
    if (summary.first_material == no_material && part.index_count > 0) summary.first_material = part.material;
    const glm::vec3 emission = materials[part.material].emission;
    if (emission.r + emission.g + emission.b > summary.emission.r + summary.emission.g + summary.emission.b)
      summary.emission = emission;
  }
  return summary;
}

float least_share_of_sky(const scene::SurfaceMesh& mesh, const std::vector<scene::SurfaceMaterial>& materials) {
  float least = 1.0f;
  for (const scene::MeshPart& part : mesh.parts)
    if (part.material < materials.size()) least = std::min(least, materials[part.material].share_of_sky);
  return least;
}

}  // namespace

SceneSummary summarise(const scene::ResolvedScene& scene) {
  SceneSummary summary;
  summary.prototypes = scene.prototypes;
  for (const scene::SurfaceMesh& mesh : scene.meshes) summary.meshes.push_back(summary_of(mesh, scene.materials));
  for (const scene::Instance& instance : scene.instances) {
    if (instance.mesh >= scene.meshes.size()) continue;
    const scene::SurfaceMesh& mesh = scene.meshes[instance.mesh];
    const float share = least_share_of_sky(mesh, scene.materials);
    if (share >= 0.5f) continue;
    // Half a metre more below and at the ends, where wheels and neighbours meet it.
    const glm::vec3 margin(0.5f);
    summary.roofs.push_back({inverse(instance.world_from_object), mesh.bounds_min_m * instance.scale - margin,
                             mesh.bounds_max_m * instance.scale + margin, share});
  }
  return summary;
}

float share_of_sky(const SceneSummary& scene, const Vec3& position_m) {
  float share = 1.0f;
  for (const Roof& roof : scene.roofs) {
    const glm::vec3 p(roof.object_from_world * position_m);
    if (p.x >= roof.min_m.x && p.y >= roof.min_m.y && p.z >= roof.min_m.z && p.x <= roof.max_m.x &&
        p.y <= roof.max_m.y && p.z <= roof.max_m.z)
      share = std::min(share, roof.share_of_sky);
  }
  return share;
}

}  // namespace septet::instant

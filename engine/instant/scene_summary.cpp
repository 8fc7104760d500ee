#include "engine/instant/scene_summary.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "engine/instant/mean_emission.hpp"

namespace septet::instant {
namespace {

MeshSummary summary_of(const scene::SurfaceMesh& mesh, const std::vector<scene::SurfaceMaterial>& materials,
                       const std::vector<glm::vec3>& emissions) {
  MeshSummary summary{{mesh.bounds_min_m, mesh.bounds_max_m}};
  for (const scene::MeshPart& part : mesh.parts) {
    if (part.material >= materials.size()) continue;
    if (summary.first_material == no_material && part.index_count > 0) summary.first_material = part.material;
    const glm::vec3 emission = emissions[part.material];
    if (emission.r + emission.g + emission.b > summary.emission.r + summary.emission.g + summary.emission.b)
      summary.emission = emission;
    summary.has_light =
        summary.has_light || emission != glm::vec3(0.0f) || materials[part.material].share_of_sky < 0.5f;
  }
  return summary;
}

/// Bounds of a body. Moving parts, lamps on roofs and parts seen only from afar are left out.
BodyBounds body_of(const scene::Prototype& prototype, const std::vector<MeshSummary>& meshes) {
  BodyBounds body{glm::vec3(1e9f), glm::vec3(-1e9f)};
  for (const scene::Instance& part : prototype.parts) {
    if (!part.casts_shadow) continue;  // Part inside of another, for example.
    if (part.mesh >= meshes.size() || part.role != scene::PartRole::fixed || part.visible_from_m > 0.0f) continue;
    const MeshBounds& bounds = meshes[part.mesh].bounds;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 share(corner & 1, corner >> 1 & 1, corner >> 2);
      const glm::vec3 at(part.world_from_object * Vec3(glm::mix(bounds.min_m, bounds.max_m, share) * part.scale));
      body.min_m = glm::min(body.min_m, at);
      body.max_m = glm::max(body.max_m, at);
    }
  }
  return body;
}

float least_share_of_sky(const scene::SurfaceMesh& mesh, const std::vector<scene::SurfaceMaterial>& materials) {
  float least = 1.0f;
  for (const scene::MeshPart& part : mesh.parts)
    if (part.material < materials.size()) least = std::min(least, materials[part.material].share_of_sky);
  return least;
}

void summarise_lights(SceneSummary& summary, const scene::ResolvedScene& scene) {
  summary.lamps = standing_lamps(scene);
  summary.roofs.clear();
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
}

void summarise_prototypes(SceneSummary& summary, const scene::ResolvedScene& scene) {
  summary.prototypes = scene.prototypes;
  summary.bodies.clear();
  for (const scene::Prototype& prototype : scene.prototypes)
    summary.bodies.push_back(body_of(prototype, summary.meshes));
}

}  // namespace

SceneSummary summarise(const scene::ResolvedScene& scene) {
  SceneSummary summary;
  const std::vector<glm::vec3> emissions = mean_emissions(scene);
  for (const scene::SurfaceMesh& mesh : scene.meshes)
    summary.meshes.push_back(summary_of(mesh, scene.materials, emissions));
  summarise_lights(summary, scene);
  summarise_prototypes(summary, scene);
  return summary;
}

bool renew(SceneSummary& summary, const scene::ResolvedScene& scene,
           std::span<const scene::ChangeList<scene::SceneChange>::Change> changes) {
  using Kind = scene::SceneChange::Kind;
  bool lights = false, bodies = false;
  std::vector<bool> new_materials;
  const std::vector<glm::vec3> emissions = mean_emissions(scene);
  const auto has_light = [&](std::uint32_t mesh) {
    return mesh < summary.meshes.size() && summary.meshes[mesh].has_light;
  };
  const auto renew_mesh = [&](std::uint32_t index) {
    const bool before = has_light(index);
    summary.meshes[index] = summary_of(scene.meshes[index], scene.materials, emissions);
    lights = lights || before || has_light(index);
  };
  summary.meshes.resize(scene.meshes.size());
  for (const auto& [revision, change] : changes) {
    if (change.kind == Kind::mesh && change.index < scene.meshes.size()) {
      renew_mesh(change.index);
      bodies = true;
    } else if (change.kind == Kind::prototype) {
      bodies = true;
    } else if (change.kind == Kind::material && change.index < scene.materials.size()) {
      new_materials.resize(scene.materials.size());
      new_materials[change.index] = true;
    }
  }
  if (!new_materials.empty())
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i)
      if (std::ranges::any_of(scene.meshes[i].parts, [&](const scene::MeshPart& part) {
            return part.material < new_materials.size() && new_materials[part.material];
          }))
        renew_mesh(i);
  for (const auto& [revision, change] : changes)
    if (change.kind == Kind::instance && change.index < scene.instances.size())
      lights = lights || has_light(change.mesh_before) || has_light(scene.instances[change.index].mesh);
  if (lights) summarise_lights(summary, scene);
  if (bodies) summarise_prototypes(summary, scene);
  return lights;
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

float share_of_sky(const SceneSummary& scene, const Vec3& from_m, const Vec3& to_m) {
  double roofed = 0.0;
  for (const Roof& roof : scene.roofs) {
    // Part of the way that lies within the box, between its three pairs of faces.
    const Vec3 from = roof.object_from_world * from_m, way = roof.object_from_world * to_m - from;
    double enters = 0.0, leaves = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = roof.min_m[axis] - from[axis], high = roof.max_m[axis] - from[axis];
      if (std::abs(way[axis]) < 1e-9) {
        if (low > 0.0 || high < 0.0) leaves = 0.0;
        continue;
      }
      enters = std::max(enters, std::min(low / way[axis], high / way[axis]));
      leaves = std::min(leaves, std::max(low / way[axis], high / way[axis]));
    }
    // Neighbours of one tunnel overlap by a metre.
    if (leaves > enters) roofed += (leaves - enters) * (1.0 - double{roof.share_of_sky});
  }
  return static_cast<float>(1.0 - std::min(1.0, roofed));
}

float share_of_sky(const SceneSummary& scene, const RigidTransform& world_from_vehicle) {
  return share_of_sky(scene, world_from_vehicle * Vec3(-7.0, 0.0, 0.8), world_from_vehicle * Vec3(9.0, 0.0, 0.8));
}

}  // namespace septet::instant

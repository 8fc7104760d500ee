#include "engine/instant/standing_lamps.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>

namespace septet::instant {
namespace {

/// Adds a triangle to the lamp before, where they share a place: two make a lens.
void add_triangle(std::vector<StandingLamp>& lamps, const Vec3& middle_m, float height_m, const glm::vec3& intensity,
                  bool roofed) {
  constexpr double together_m = 1.5;
  if (!lamps.empty() && lamps.back().roofed == roofed && glm::length(lamps.back().position_m - middle_m) < together_m) {
    StandingLamp& lamp = lamps.back();
    const float before = lamp.intensity.g, now = intensity.g;
    lamp.position_m = glm::mix(lamp.position_m, middle_m, double(now / std::max(before + now, 1e-9f)));
    lamp.intensity += intensity;
    return;
  }
  lamps.push_back({middle_m, std::clamp(height_m, 2.5f, 14.0f), intensity, roofed});
}

}  // namespace

std::vector<StandingLamp> standing_lamps(const scene::ResolvedScene& scene) {
  std::vector<StandingLamp> lamps;
  for (const scene::Instance& instance : scene.instances) {
    if (instance.mesh >= scene.meshes.size()) continue;
    const scene::SurfaceMesh& mesh = scene.meshes[instance.mesh];
    for (const scene::MeshPart& part : mesh.parts) {
      if (part.material >= scene.materials.size()) continue;
      const scene::SurfaceMaterial& material = scene.materials[part.material];
      if (!(material.emission.r + material.emission.g + material.emission.b > 0.0f)) continue;
      const std::size_t end =
          std::min<std::size_t>(std::size_t{part.first_index} + part.index_count, mesh.indices.size());
      for (std::size_t i = part.first_index; i + 2 < end; i += 3) {
        std::array<Vec3, 3> at;
        float height_m = 0.0f;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t vertex = mesh.indices[i + k];
          if (vertex >= mesh.vertices.size()) return lamps;
          const glm::vec3 local = mesh.vertices[vertex].position_m * instance.scale;
          height_m += local.z / 3.0f;
          at[k] = instance.world_from_object * Vec3(local);
        }
        const glm::vec3 across(0.5 * glm::cross(at[1] - at[0], at[2] - at[0]));
        const float area_m2 = glm::length(across);
        if (!(area_m2 > 1e-4f) || !looks_down(across / area_m2)) continue;
        add_triangle(lamps, (at[0] + at[1] + at[2]) / 3.0, height_m, material.emission * area_m2,
                     material.share_of_sky < 0.5f);
      }
    }
  }
  return lamps;
}

}  // namespace septet::instant

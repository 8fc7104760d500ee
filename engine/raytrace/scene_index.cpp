#include "engine/raytrace/scene_index.hpp"

#include <algorithm>
#include <cstddef>

#include <glm/vec3.hpp>

#include "engine/instant/mean_emission.hpp"

namespace septet::raytrace {
namespace {

constexpr std::uint32_t no_material = 0xffffffffu;

bool is_cut(const scene::SurfaceMaterial& material, const scene::ResolvedScene& scene) {
  if (material.opacity < opaque_from || material.base_color_image < 0 ||
      static_cast<std::size_t>(material.base_color_image) >= scene.images.size())
    return false;
  const auto& rgba = scene.images[static_cast<std::size_t>(material.base_color_image)].rgba;
  for (std::size_t i = 3; i < rgba.size(); i += 4)
    if (rgba[i] < 128) return true;
  return false;
}

}  // namespace

SceneIndex::SceneIndex(const scene::ResolvedScene& scene) : lamp_emission(instant::mean_emissions(scene)) {
  for (const scene::SurfaceMaterial& material : scene.materials) {
    cut.push_back(is_cut(material, scene));
    shows_back.push_back(material.two_sided || cut.back() || material.stripe || material.opacity < opaque_from);
    plain.push_back(material.base_color_image < 0 && material.maps == scene::no_surface_maps &&
                    material.opacity >= opaque_from && material.metallic == 0.0f && material.roughness >= rough_from &&
                    material.clear_coat <= 0.0f && !material.wettable && material.retroreflection == 0.0f &&
                    material.emission == glm::vec3(0.0f));
  }
  const auto is_open = [&](const scene::MeshPart& part) {
    return part.material < cut.size() && (cut[part.material] || scene.materials[part.material].opacity < opaque_from);
  };
  for (const scene::SurfaceMesh& mesh : scene.meshes) {
    open.push_back(std::ranges::any_of(mesh.parts, is_open));
    materials.push_back(triangle_materials(mesh));
  }
}

std::vector<std::uint32_t> triangle_materials(const scene::SurfaceMesh& mesh) {
  std::vector<std::uint32_t> of_triangles(mesh.indices.size() / 3, no_material);
  // First part wins where two hold a triangle.
  for (auto part = mesh.parts.rbegin(); part != mesh.parts.rend(); ++part)
    for (std::size_t n = part->first_index; n < std::size_t{part->first_index} + part->index_count; n += 3)
      if (n / 3 < of_triangles.size()) of_triangles[n / 3] = part->material;
  if (!of_triangles.empty() && std::ranges::all_of(of_triangles, [&](auto m) { return m == of_triangles[0]; }))
    of_triangles.resize(1);
  of_triangles.shrink_to_fit();
  return of_triangles;
}

}  // namespace septet::raytrace

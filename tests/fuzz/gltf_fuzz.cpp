// glTF files of any bytes: a whole model, or an error with fault, place and remedy.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <glm/gtc/quaternion.hpp>

#include "engine/gltf/gltf.hpp"
#include "engine/math/pose_keys.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace septet;
  const auto model = gltf::read_gltf(std::string_view(reinterpret_cast<const char*>(bytes), size), "fuzz.glb",
                                     [](std::string_view name) { return name.starts_with("wheel"); });
  if (!model) {
    const Error& error = model.error();
    if (error.what.empty() || error.remedy.empty() || !error.where.starts_with("fuzz.glb")) std::abort();
    return 0;
  }
  for (const gltf::Part& part : model->parts) {
    const geometry::PolygonMesh& mesh = part.mesh;
    if (mesh.polygons.empty() || mesh.polygons.size() > gltf::most_triangles) std::abort();
    if (mesh.polygon_materials.size() != mesh.polygons.size()) std::abort();
    for (const std::size_t corners : {mesh.corner_uvs.size(), mesh.second_corner_uvs.size(), mesh.corner_colors.size(),
                                      mesh.corner_tangents.size()})
      if (corners != 0 && corners != mesh.polygons.size()) std::abort();
    for (const auto& corners : mesh.polygons)
      for (int k = 0; k < 3; ++k)
        if (corners[static_cast<std::size_t>(k)] >= mesh.vertices_m.size()) std::abort();
    for (const std::uint32_t material : mesh.polygon_materials)
      if (material >= model->looks.size()) std::abort();
    for (const glm::vec3& p : mesh.vertices_m)
      if (!(std::abs(p.x) + std::abs(p.y) + std::abs(p.z) < 1e5f)) std::abort();
    if (part.keys.size() > max_pose_keys) std::abort();
    float before_s = 0.0f;
    for (const PoseKey& key : part.keys) {
      if (!(key.at_s >= before_s)) std::abort();
      before_s = key.at_s;
      for (int k = 0; k < 3; ++k)
        if (!std::isfinite(key.position_m[k]) || !std::isfinite(key.scale[k])) std::abort();
      if (!(std::abs(glm::dot(key.rotation, key.rotation) - 1.0f) < 1e-3f)) std::abort();
    }
    for (const auto& layer : {mesh.corner_uvs, mesh.second_corner_uvs})
      for (const auto& uvs : layer)
        for (const glm::vec2& uv : uvs)
          if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) std::abort();
  }
  for (const gltf::Look& look : model->looks)
    for (const std::int32_t picture :
         {look.picture, look.emission_picture, look.properties_picture, look.normal_picture})
      if (picture >= static_cast<std::int32_t>(model->pictures.size())) std::abort();
  return 0;
}

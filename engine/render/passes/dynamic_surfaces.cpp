#include "engine/render/passes/dynamic_surfaces.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace septet::render {
namespace {

void upload_reshaped(PassContext& context, const Instant& instant, DynamicSurfaces& surfaces) {
  for (const PlacedMesh& placed : instant.parts) {
    if (!placed.reshaped || surfaces.reshaped.contains(placed.reshaped)) continue;
    const scene::SurfaceMesh& mesh = *placed.reshaped;
    const auto holds = [&](std::uint32_t index) { return index < mesh.vertices.size(); };
    if (!std::ranges::all_of(mesh.indices, holds)) continue;
    ReshapedSurface surface;
    for (const scene::MeshPart& part : mesh.parts)
      if (part.index_count > 0 && part.first_index <= mesh.indices.size() &&
          part.index_count <= mesh.indices.size() - part.first_index)
        surface.parts.push_back(part);
    surface.vertices = store(context, std::span<const scene::SurfaceVertex>(mesh.vertices));
    surface.indices = store(context, std::span<const std::uint32_t>(mesh.indices));
    surfaces.reshaped.emplace(placed.reshaped, std::move(surface));
  }
}

}  // namespace

DynamicSurfaces upload_dynamic(PassContext& context, const DeviceScene& scene, const Instant& instant) {
  DynamicSurfaces result;
  upload_reshaped(context, instant, result);
  std::uint32_t longest = 0;
  for (const auto& [mesh, material, share_of_sky] : instant.loose) {
    if (material >= scene.materials.size()) continue;
    DynamicSurface surface;
    surface.placed.origin_m = mesh.origin_m;
    surface.placed.radius_m = mesh.radius_m;
    surface.placed.tint = glm::vec4(mesh.paint, 1.0f);
    surface.placed.number = mesh.number;
    surface.placed.share_of_sky = share_of_sky;
    surface.placed.seen = mesh.seen;
    const FrameData vertices = store(context, std::span<const scene::SurfaceVertex>(mesh.vertices));
    surface.vertices = vertices.buffer;
    surface.vertices_at = vertices.offset;
    surface.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size() / 3 * 3);
    surface.material = material;
    longest = std::max(longest, surface.vertex_count);
    result.surfaces.push_back(surface);
  }
  std::vector<std::uint32_t> indices(longest);
  std::iota(indices.begin(), indices.end(), 0u);
  if (longest > 0) result.indices = store(context, std::span<const std::uint32_t>(indices));
  return result;
}

void append_dynamic(const DynamicSurfaces& dynamic, const Vec3& eye_m, const Keep& keep, const GroupOf& group_of,
                    std::vector<SurfaceDraw>& list, std::vector<InstanceRecord>& records) {
  for (const DynamicSurface& surface : dynamic.surfaces) {
    const glm::vec3 at(surface.placed.origin_m - eye_m);
    const std::uint32_t group = group_of(surface.material);
    if (group == no_group || !keep(surface.placed, at)) continue;
    SurfaceDraw draw;
    draw.vertices = surface.vertices;
    draw.vertices_at = surface.vertices_at;
    draw.indices = dynamic.indices.buffer;
    draw.indices_at = dynamic.indices.offset;
    draw.index_count = surface.vertex_count;
    draw.first_instance = static_cast<std::uint32_t>(records.size());
    draw.instance_count = 1;
    draw.material = group;
    list.push_back(draw);
    records.push_back(record_of(surface.placed, at));
  }
}

}  // namespace septet::render

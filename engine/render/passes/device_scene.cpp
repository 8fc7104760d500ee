#include "engine/render/passes/device_scene.hpp"

#include <algorithm>
#include <initializer_list>

#include "engine/core/hash.hpp"
#include "engine/core/parallel_for.hpp"
#include "engine/render/passes/stripes.hpp"

namespace septet::render {
namespace {

using scene::ResolvedScene;
using scene::SurfaceMaterial;
using scene::SurfaceMesh;
using vulkan::Buffer;

/// Buffer on the device with these bytes, one span after another.
Buffer create_filled_buffer(vulkan::Upload& upload, VkBufferUsageFlags usage,
                            std::initializer_list<std::span<const std::byte>> contents) {
  std::uint64_t size = 0;
  for (const auto& bytes : contents) size += bytes.size();
  Buffer target =
      create_buffer(upload.memory(), size, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, vulkan::MemoryUse::device_only);
  std::byte* at = target.mapped;
  if (!at) {
    const vulkan::HostArena::Slice staged = upload.stage(size);
    at = staged.data;
    upload.add([staged, size, buffer = target.buffer](VkCommandBuffer commands) {
      const VkBufferCopy region{staged.offset, 0, size};
      vkCmdCopyBuffer(commands, staged.buffer, buffer, 1, &region);
    });
  }
  for (const auto& bytes : contents) at = std::copy(bytes.begin(), bytes.end(), at);
  return target;
}

bool indices_hold(const SurfaceMesh& mesh) {
  return std::all_of(mesh.indices.begin(), mesh.indices.end(),
                     [&](std::uint32_t index) { return index < mesh.vertices.size(); });
}

}  // namespace

void upload_mesh(DeviceMesh& target, const SurfaceMesh& mesh, std::span<const DeviceMaterial> materials,
                 vulkan::Upload& upload) {
  destroy_buffer(upload.memory(), target.buffer);
  target = {mesh.revision, true, {}, 0, {}};
  if (mesh.indices.empty() || !indices_hold(mesh)) return;
  for (const scene::MeshPart& part : mesh.parts)
    if (part.index_count > 0 && part.first_index <= mesh.indices.size() &&
        part.index_count <= mesh.indices.size() - part.first_index)
      target.parts.push_back(part);
  std::vector<scene::SurfaceVertex> with_edges;
  for (const scene::MeshPart& part : target.parts) {
    if (part.material >= materials.size() || !materials[part.material].stripe) continue;
    if (with_edges.empty()) with_edges = mesh.vertices;
    find_stripe_edges(with_edges, std::span(mesh.indices).subspan(part.first_index, part.index_count));
  }
  const auto vertices = std::as_bytes(std::span(with_edges.empty() ? mesh.vertices : with_edges));
  target.indices_at = vertices.size();
  target.buffer = create_filled_buffer(upload, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                                       {vertices, std::as_bytes(std::span(mesh.indices))});
}

DeviceMaterial device_material(const SurfaceMaterial& material, std::span<const DeviceTexture> textures) {
  DeviceMaterial result;
  const auto texture_at = [&](std::int32_t image) -> const DeviceTexture* {
    if (image < 0 || static_cast<std::size_t>(image) >= textures.size()) return nullptr;
    const DeviceTexture& texture = textures[static_cast<std::size_t>(image)];
    return texture.image.image ? &texture : nullptr;
  };
  const DeviceTexture* base = texture_at(material.base_color_image);
  const bool textured = base != nullptr;
  result.image = textured ? material.base_color_image : -1;
  result.square_root_bits = !base || base->square_roots ? 1u : 0u;
  for (std::uint32_t map = 0; map < scene::surface_map_count; ++map)
    if (const DeviceTexture* texture = texture_at(material.maps.values[map])) {
      result.maps.values[map] = material.maps.values[map];
      result.map_bits |= 1u << map;
      result.square_root_bits |= std::uint32_t{texture->square_roots} << (map + 1);
    }
  result.second_uv_bits = material.by_second_uv & result.map_bits;
  result.blended = is_blended(material);
  result.cut = textured && !result.blended && base->holes;
  const bool mapped = result.maps[scene::SurfaceMap::properties] >= 0;
  result.glossy = !result.cut && (material.roughness < 0.6f || material.metallic > 0.2f || result.blended || mapped);
  result.wettable = material.wettable && !result.cut;
  result.coated = material.clear_coat > 0.0f && !result.cut && !result.blended && !result.wettable;
  result.stripe = material.stripe;
  result.two_sided = material.two_sided && !result.cut && !result.stripe;
  result.in_street = material.in_street;
  // Fresnel at normal incidence, ((n − 1)/(n + 1))².
  const float ratio = (material.refraction_index - 1.0f) / (material.refraction_index + 1.0f);
  result.constants.base_color = glm::vec4(material.base_color, material.opacity);
  result.constants.emission = glm::vec4(material.emission, std::clamp(material.roughness, 0.05f, 1.0f));
  result.constants.surface = glm::vec4(material.metallic, ratio * ratio, material.clear_coat, material.takes_paint);
  result.constants.light = glm::vec4(material.share_of_sky, material.retroreflection,
                                     textured ? material.picture_columns : 1u, textured ? material.picture_rows : 1u);
  result.constants.more = glm::vec4(material.ambient_share, material.lit_by_night, 0.0f, 0.0f);
  return result;
}

void place_instances(DeviceScene& scene, const ResolvedScene& source) {
  scene.placed.clear();
  scene.vacated = 0;
  scene.placed_at.assign(source.instances.size(), nowhere);
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < source.instances.size(); ++i) {
    const std::uint32_t mesh = source.instances[i].mesh;
    if (mesh < source.meshes.size() && !scene.is_still(mesh)) order.push_back(i);
  }
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return source.instances[i].mesh; });
  for (const std::uint32_t i : order) {
    const scene::Instance& instance = source.instances[i];
    scene.placed_at[i] = static_cast<std::uint32_t>(scene.placed.size());
    scene.placed.push_back(place(instance, scene.summary.meshes[instance.mesh].bounds, instance.world_from_object));
  }
}

namespace {

/// Hash of everything that static geometry is made of.
std::uint64_t hash_of_still(const ResolvedScene& source, const std::vector<bool>& still) {
  StateHash hash;
  for (const scene::Instance& instance : source.instances) {
    if (instance.mesh >= source.meshes.size() || !still[instance.mesh]) continue;
    const Vec3& p = instance.world_from_object.position_m;
    const Quat& q = instance.world_from_object.orientation;
    hash.add(instance.mesh);
    hash.add(source.meshes[instance.mesh].revision);
    hash.add(std::uint32_t{instance.casts_shadow});
    for (const double value :
         {p.x, p.y, p.z, q.w, q.x, q.y, q.z, double(instance.scale.x), double(instance.scale.y),
          double(instance.scale.z), double(instance.visible_from_m), double(instance.visible_to_m)})
      hash.add(value);
  }
  return hash.value();
}

void upload_still(DeviceScene& scene, const ResolvedScene& source, const std::vector<bool>& still,
                  vulkan::Upload& upload) {
  scene.still_instance.assign(source.meshes.size(), nowhere);
  for (std::uint32_t i = 0; i < source.instances.size(); ++i)
    if (const std::uint32_t mesh = source.instances[i].mesh; mesh < still.size() && still[mesh])
      scene.still_instance[mesh] = i;
  const std::uint64_t hash = hash_of_still(source, still);
  if (hash == scene.still_hash) return;
  for (Buffer& vertices : scene.still_vertices) destroy_buffer(upload.memory(), vertices);
  scene.still_vertices.clear();
  scene.still = static_geometry(source, still);
  for (StaticBlock& block : scene.still.blocks) {
    scene.still_vertices.emplace_back();
    if (block.vertices.empty()) continue;
    scene.still_vertices.back() =
        create_filled_buffer(upload, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, {std::as_bytes(std::span(block.vertices))});
    block.vertices = {};
  }
  scene.still_piece.assign(source.meshes.size(), nowhere);
  for (std::uint32_t i = 0; i < scene.still.pieces.size(); ++i)
    scene.still_piece[scene.still.pieces[i].placed.mesh] = i;
  scene.still_hash = hash;
}

}  // namespace

void upload_scene(DeviceScene& scene, const ResolvedScene& source, const vulkan::Device& device,
                  vulkan::MemoryPool& memory) {
  vulkan::Upload upload(device, memory);
  upload_textures(scene.textures, source, upload);
  scene.materials.clear();
  for (const SurfaceMaterial& material : source.materials)
    scene.materials.push_back(device_material(material, scene.textures));
  while (scene.meshes.size() > source.meshes.size()) {
    destroy_buffer(memory, scene.meshes.back().buffer);
    scene.meshes.pop_back();
  }
  scene.meshes.resize(source.meshes.size());
  std::vector<bool> still = placed_once(source);
  scene.edited.resize(still.size());
  for (std::size_t i = 0; i < still.size(); ++i) still[i] = still[i] && !scene.edited[i];
  for (std::size_t i = 0; i < source.meshes.size(); ++i) {
    const SurfaceMesh& mesh = source.meshes[i];
    if (still[i]) {
      destroy_buffer(memory, scene.meshes[i].buffer);
      scene.meshes[i] = {};
    } else if (!scene.meshes[i].present || scene.meshes[i].revision != mesh.revision) {
      upload_mesh(scene.meshes[i], mesh, scene.materials, upload);
    }
  }
  scene.summary = summarise(source);
  upload_still(scene, source, still, upload);
  place_instances(scene, source);
  upload.finish();
  scene.lamps_revision = scene.whole_revision = source.revision;
  scene.revision = source.revision;
}

void destroy_scene(DeviceScene& scene, vulkan::MemoryPool& memory) {
  for (DeviceMesh& mesh : scene.meshes) destroy_buffer(memory, mesh.buffer);
  for (Buffer& vertices : scene.still_vertices) destroy_buffer(memory, vertices);
  for (DeviceTexture& texture : scene.textures) destroy_image(memory, texture.image);
  scene = {};
}

}  // namespace septet::render

#include "engine/render/passes/surface_draws.hpp"

#include "engine/render/passes/dynamic_surfaces.hpp"

#include <map>
#include <span>
#include <tuple>
#include <vector>

namespace septet::render {
namespace {

/// Triangles of a batch: buffers and parts.
struct Triangles {
  VkBuffer vertices, indices;
  std::uint64_t indices_at, vertices_at;
  std::span<const scene::MeshPart> parts;
};

Triangles triangles_of(const Batch& batch, const DeviceScene& scene, const DynamicSurfaces& dynamic) {
  if (const auto found = dynamic.reshaped.find(batch.reshaped); batch.reshaped && found != dynamic.reshaped.end()) {
    const ReshapedSurface& surface = found->second;
    return {surface.vertices.buffer, surface.indices.buffer, surface.indices.offset, surface.vertices.offset,
            surface.parts};
  }
  const DeviceMesh& mesh = scene.meshes[batch.mesh];
  return {mesh.buffer.buffer, mesh.buffer.buffer, mesh.indices_at, 0, mesh.parts};
}

/// Adds a batch's parts; adjacent parts of one group become one draw.
void add_batch(std::vector<SurfaceDraw>& list, const Triangles& mesh, const Batch& batch, const GroupOf& group_of) {
  bool open = false;
  for (const scene::MeshPart& part : mesh.parts) {
    const std::uint32_t group = group_of(part.material);
    if (group == no_group) {
      open = false;
      continue;
    }
    if (open && list.back().material == group &&
        list.back().first_index + list.back().index_count == part.first_index) {
      list.back().index_count += part.index_count;
      continue;
    }
    list.push_back({mesh.vertices, mesh.indices, mesh.indices_at, mesh.vertices_at, part.first_index, part.index_count,
                    batch.first, batch.count, group, batch.fading, batch.still});
    open = true;
  }
}

}  // namespace

SurfaceDraws prepare_draws(PassContext& context, const DeviceScene& scene, std::span<const PlacedMesh> participants,
                           const DynamicSurfaces& dynamic, const Vec3& eye_m, const Keep& keep, const GroupOf& group_of,
                           const DetailOf& detail, const ViewVolume* volume) {
  SurfaceDraws draws;
  DrawList instanced;
  append_visible(instanced, scene.placed, eye_m, keep, detail.still, true);
  append_visible(instanced, participants, eye_m, keep, detail.participants);
  sort_by_distance(instanced);
  for (const Batch& batch : instanced.batches)
    add_batch(draws.list, triangles_of(batch, scene, dynamic), batch, group_of);
  append_dynamic(dynamic, eye_m, keep, group_of, draws.list, instanced.records);

  const Gathered gathered = gather(scene.still, eye_m, keep, group_of, detail.still, volume);
  draws.instances = static_cast<std::uint32_t>(instanced.records.size()) + gathered.pieces;
  const FrameData indices = store(context, std::span<const std::uint32_t>(gathered.indices));
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> record_of_block;
  for (const GatheredDraw& draw : gathered.draws) {
    const auto [found, added] = record_of_block.try_emplace({draw.block, draw.fade.from, draw.fade.to},
                                                            static_cast<std::uint32_t>(instanced.records.size()));
    if (added) instanced.records.push_back(record_of(scene.still.blocks[draw.block], eye_m, draw.fade));
    draws.list.push_back({scene.still_vertices[draw.block].buffer, indices.buffer, indices.offset, 0, draw.first_index,
                          draw.index_count, found->second, 1, draw.group, !draw.fade.all(), true});
  }
  draws.records = store(context, std::span<const InstanceRecord>(instanced.records));
  return draws;
}

void record_draw(PassContext& context, const SurfaceDraw& draw, SurfaceDraw& bound) {
  const VkCommandBuffer commands = context.slot.commands;
  if (draw.vertices != bound.vertices || draw.vertices_at != bound.vertices_at) {
    const VkDeviceSize at = draw.vertices_at;
    vkCmdBindVertexBuffers(commands, 0, 1, &draw.vertices, &at);
  }
  if (draw.indices != bound.indices || draw.indices_at != bound.indices_at)
    vkCmdBindIndexBuffer(commands, draw.indices, draw.indices_at, VK_INDEX_TYPE_UINT32);
  bound = draw;
  vkCmdDrawIndexed(commands, draw.index_count, draw.instance_count, draw.first_index, 0, draw.first_instance);
  context.statistics.triangles += draw.index_count / 3 * draw.instance_count;
  ++context.statistics.draws;
}

}  // namespace septet::render

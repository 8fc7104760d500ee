#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/render/passes/ice_pass.hpp"
#include "engine/render/passes/shaders.hpp"

namespace septet::render {
namespace {

/// Pipeline that blends over the view's contents; a sheet this thin does not refract them.
VkPipeline glass_pipeline(IcePass& pass, PassContext& context, ice::OnGlass what) {
  VkPipeline& pipeline = pass.glass[what == ice::OnGlass::frost ? 0 : 1];
  if (pipeline) return pipeline;
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::ice_vert();
  description.fragment_code = shaders::ice_glass_frag();
  description.vertex_input = vulkan::VertexInput::ice;
  description.color_format = context.formats.radiance;
  description.marks = context.formats.marks;
  description.depth_format = context.formats.depth;
  description.samples = context.formats.samples;
  description.blend = vulkan::Blend::over;
  description.depth_write = false;
  description.constants = {what == ice::OnGlass::cracks};
  return pipeline = create_pipeline(context.device, context.layout, description);
}

}  // namespace

std::vector<FrameData> upload_glass(PassContext& context, std::span<const ice::IceBody> bodies) {
  std::vector<FrameData> vertices;
  for (const ice::IceBody& body : bodies)
    vertices.push_back(store(context, std::span<const ice::IceVertex>(body.vertices)));
  return vertices;
}

void draw_glass(IcePass& pass, PassContext& context, std::span<const ice::IceBody> bodies,
                std::span<const FrameData> vertices, const Vec3& eye_m, bool near) {
  constexpr double reach_m = 1.6;
  vkCmdSetCullMode(context.slot.commands, VK_CULL_MODE_NONE);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const ice::IceBody& body = bodies[i];
    const Vec3 place = body.origin_m - eye_m;
    if (body.look.on_glass == ice::OnGlass::nothing || (glm::length(place) < reach_m) != near) continue;
    IceConstants constants{};
    constants.origin = glm::vec4(glm::vec3(place), body.look.share_of_sky);
    const auto count = static_cast<std::uint32_t>(body.vertices.size() / 3 * 3);
    vkCmdBindPipeline(context.slot.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      glass_pipeline(pass, context, body.look.on_glass));
    push_constants(context, std::as_bytes(std::span(&constants, 1)));
    vkCmdBindVertexBuffers(context.slot.commands, 0, 1, &vertices[i].buffer, &vertices[i].offset);
    vkCmdDraw(context.slot.commands, count, 1, 0, 0);
    context.statistics.triangles += count / 3;
    ++context.statistics.draws;
  }
}

}  // namespace septet::render

#include "engine/render/passes/ice_pass.hpp"

#include <algorithm>
#include <array>

#include "engine/effects/ice/cracks.hpp"
#include "engine/render/passes/shaders.hpp"

namespace septet::render {
namespace {

constexpr VkFormat layer_format = VK_FORMAT_R32G32B32A32_SFLOAT, inside_format = VK_FORMAT_R16G16B16A16_SFLOAT;

void destroy_ice_targets(IcePass& pass, vulkan::MemoryPool& memory) {
  IceTargets& targets = pass.targets;
  for (vulkan::DeviceImage* image : {&targets.front, &targets.back, &targets.depth, &targets.inside, &targets.around,
                                     &targets.around_depth, &targets.cube})
    destroy_image(memory, *image);
  targets = {};
}

void push_layer(PassContext& context, std::uint32_t binding, VkImageView view) {
  const VkDescriptorImageInfo info{context.samplers.table, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  VkWriteDescriptorSet image{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  image.dstBinding = binding;
  image.descriptorCount = 1;
  image.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  image.pImageInfo = &info;
  vkCmdPushDescriptorSetKHR(context.slot.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, context.layout.layout, 0, 1,
                            &image);
}

void draw_vertices(PassContext& context, const FrameData& vertices, std::uint32_t count, std::uint32_t first = 0) {
  if (count == 0) return;
  vkCmdBindVertexBuffers(context.slot.commands, 0, 1, &vertices.buffer, &vertices.offset);
  vkCmdDraw(context.slot.commands, count, 1, first, 0);
  context.statistics.triangles += count / 3;
  ++context.statistics.draws;
}

VkPipeline layer_pipeline(IcePass& pass, PassContext& context) {
  if (pass.layer) return pass.layer;
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::ice_layer_vert();
  description.fragment_code = shaders::ice_layer_frag();
  description.vertex_input = vulkan::VertexInput::ice;
  description.color_format = layer_format;
  description.depth_format = context.formats.depth;
  description.blend = vulkan::Blend::data;
  return pass.layer = create_pipeline(context.device, context.layout, description);
}

/// Nearer than the back face, over its normal; its depth, the fourth number, stays.
VkPipeline crack_pipeline(IcePass& pass, PassContext& context) {
  if (pass.cracks) return pass.cracks;
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::ice_layer_vert();
  description.fragment_code = shaders::ice_crack_frag();
  description.vertex_input = vulkan::VertexInput::ice;
  description.color_format = layer_format;
  description.depth_format = context.formats.depth;
  description.depth_write = false;
  description.blend = vulkan::Blend::over;
  return pass.cracks = create_pipeline(context.device, context.layout, description);
}

/// `kind` as in shaders/ice_inside.frag.
VkPipeline inside_pipeline(IcePass& pass, PassContext& context, bool quality, std::uint32_t kind) {
  VkPipeline& pipeline = pass.insides[std::uint32_t{quality} | kind << 1];
  if (pipeline) return pipeline;
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::ice_layer_vert();
  description.fragment_code = shaders::ice_inside_frag();
  description.vertex_input = vulkan::VertexInput::ice;
  description.color_format = inside_format;
  description.depth_write = false;
  description.blend = vulkan::Blend::layer;
  description.constants = {quality, kind};
  return pipeline = create_pipeline(context.device, context.layout, description);
}

VkPipeline front_pipeline(IcePass& pass, PassContext& context, const ice::IceBody& body) {
  const std::array<std::uint32_t, 4> constants{body.look.mode == ice::Mode::quality, body.look.two_sided,
                                               !body.inside.empty(), body.look.roughness > 0.0f};
  VkPipeline& pipeline = pass.fronts[constants[0] | constants[1] << 1 | constants[2] << 2 | constants[3] << 3];
  if (pipeline) return pipeline;
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::ice_vert();
  description.fragment_code = shaders::ice_frag();
  description.vertex_input = vulkan::VertexInput::ice;
  description.color_format = context.formats.radiance;
  description.depth_format = context.formats.depth;
  description.samples = context.formats.samples;
  description.constants = {constants[0], constants[1], constants[2], constants[3]};
  return pipeline = create_pipeline(context.device, context.layout, description);
}

void begin_layer(PassContext& context, const IceTargets& targets, IceLayer layer, const IceTiles& tiles) {
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = layer == IceLayer::front  ? targets.front.view
                    : layer == IceLayer::back ? targets.back.view
                                              : targets.inside.view;
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  depth.imageView = targets.depth.view;
  depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = {{0, 0}, {tiles.used_width, tiles.used_height}};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  if (layer != IceLayer::inside) rendering.pDepthAttachment = &depth;
  vkCmdBeginRendering(context.slot.commands, &rendering);
  set_viewport(context, {0, 0, targets.front.description.width, targets.front.description.height});
  vkCmdSetFrontFace(context.slot.commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
}

void begin_tile(PassContext& context, const IceTile& tile) {
  const VkRect2D scissor{{tile.rectangle.x, tile.rectangle.y}, {tile.rectangle.width, tile.rectangle.height}};
  vkCmdSetScissor(context.slot.commands, 0, 1, &scissor);
  push_constants(context, std::as_bytes(std::span(&tile.constants, 1)));
}

}  // namespace

IceUpload upload_ice(PassContext& context, std::span<const ice::IceBody> bodies) {
  IceUpload upload;
  for (const ice::IceBody& body : bodies) {
    IceUpload::Vertices vertices;
    vertices.surface = store(context, std::span<const ice::IceVertex>(body.vertices));
    vertices.surface_count = static_cast<std::uint32_t>(body.vertices.size() / 3 * 3);
    vertices.inside = store(context, std::span<const ice::IceVertex>(body.inside));
    vertices.inside_count = static_cast<std::uint32_t>(body.inside.size() / 3 * 3);
    const auto is_air = [](const ice::IceVertex& v) { return v.rest_m.z == float(ice::InsideKind::air); };
    vertices.first_air = vertices.inside_count;
    while (vertices.first_air > 0 && is_air(body.inside[vertices.first_air - 1])) --vertices.first_air;
    vertices.first_air = (vertices.first_air + 2) / 3 * 3;
    vertices.mixed = std::any_of(body.inside.begin(), body.inside.begin() + vertices.first_air, is_air);
    upload.bodies.push_back(vertices);
  }
  return upload;
}

bool ice_targets_fit(const IcePass& pass, std::uint32_t width, std::uint32_t height, std::uint32_t surroundings_px) {
  return pass.targets.front.description.width == width && pass.targets.front.description.height == height &&
         pass.targets.cube.description.width == surroundings_px;
}

void prepare_ice_targets(IcePass& pass, PassContext& context, std::uint32_t width, std::uint32_t height,
                         std::uint32_t surroundings_px) {
  if (ice_targets_fit(pass, width, height, surroundings_px)) return;
  destroy_ice_targets(pass, context.memory);
  IceTargets& targets = pass.targets;
  vulkan::ImageDescription description;
  description.width = width;
  description.height = height;
  description.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  description.format = layer_format;
  targets.front = create_image(context.memory, description);
  targets.back = create_image(context.memory, description);
  description.format = inside_format;
  targets.inside = create_image(context.memory, description);
  description.format = context.formats.depth;
  description.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  description.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
  targets.depth = create_image(context.memory, description);
  description.width = 3 * surroundings_px;
  description.height = 2 * surroundings_px;
  description.samples = context.formats.samples;
  targets.around_depth = create_image(context.memory, description);
  description.aspect = VK_IMAGE_ASPECT_COLOR_BIT;
  description.format = context.formats.radiance;
  description.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  targets.around = create_image(context.memory, description);
  description.width = description.height = surroundings_px;
  description.samples = VK_SAMPLE_COUNT_1_BIT;
  description.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  description.layers = 6;
  description.cube = true;
  targets.cube = create_image(context.memory, description);
}

void destroy_ice_pass(IcePass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory) {
  destroy_ice_targets(pass, memory);
  for (const auto& pipelines : {pass.fronts, pass.insides})
    for (const auto& [key, pipeline] : pipelines)
      if (pipeline) vkDestroyPipeline(device.device, pipeline, nullptr);
  for (const VkPipeline pipeline : {pass.layer, pass.cracks})
    if (pipeline) vkDestroyPipeline(device.device, pipeline, nullptr);
  pass = {};
}

void draw_ice_layer(IcePass& pass, PassContext& context, IceLayer layer, const IceTiles& tiles,
                    std::span<const ice::IceBody> bodies, const IceUpload& upload, const ViewBindings& bindings) {
  const VkCommandBuffer commands = context.slot.commands;
  begin_layer(context, pass.targets, layer, tiles);
  push_view(context, bindings);
  if (layer != IceLayer::front) push_layer(context, vulkan::binding_ice_front, pass.targets.front.view);
  if (layer == IceLayer::inside) {
    push_layer(context, vulkan::binding_ice_back, pass.targets.back.view);
    push_layer(context, vulkan::binding_surroundings, pass.targets.cube.view);
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    for (const IceTile& tile : tiles.list) {
      const IceUpload::Vertices& vertices = upload.bodies[tile.body];
      if (vertices.inside_count == 0) continue;
      const bool quality = bodies[tile.body].look.mode == ice::Mode::quality;
      begin_tile(context, tile);
      vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                        inside_pipeline(pass, context, quality, vertices.mixed ? 0 : 1));
      draw_vertices(context, vertices.inside, vertices.first_air);
      vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, inside_pipeline(pass, context, quality, 2));
      draw_vertices(context, vertices.inside, vertices.inside_count - vertices.first_air, vertices.first_air);
    }
  } else {
    vkCmdSetCullMode(commands, layer == IceLayer::front ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_FRONT_BIT);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layer_pipeline(pass, context));
    for (const IceTile& tile : tiles.list) {
      begin_tile(context, tile);
      draw_vertices(context, upload.bodies[tile.body].surface, upload.bodies[tile.body].surface_count);
    }
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    for (const IceTile& tile : tiles.list) {
      const ice::Look& look = bodies[tile.body].look;
      const IceUpload::Vertices& vertices = upload.bodies[tile.body];
      if (layer != IceLayer::back || look.mode != ice::Mode::quality || !look.bent_by_cracks ||
          vertices.inside_count == 0)
        continue;
      vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, crack_pipeline(pass, context));
      begin_tile(context, tile);
      draw_vertices(context, vertices.inside, vertices.inside_count);
    }
  }
  vkCmdEndRendering(commands);
}

void draw_ice(IcePass& pass, PassContext& context, const IceTiles& tiles, std::uint32_t view,
              std::span<const ice::IceBody> bodies, const IceUpload& upload) {
  if (std::ranges::none_of(tiles.list, [&](const IceTile& tile) { return tile.view == view; })) return;
  push_layer(context, vulkan::binding_ice_front, pass.targets.front.view);
  push_layer(context, vulkan::binding_ice_back, pass.targets.back.view);
  push_layer(context, vulkan::binding_ice_inside, pass.targets.inside.view);
  push_layer(context, vulkan::binding_surroundings, pass.targets.cube.view);
  vkCmdSetCullMode(context.slot.commands, VK_CULL_MODE_BACK_BIT);
  for (const IceTile& tile : tiles.list) {
    if (tile.view != view) continue;
    vkCmdBindPipeline(context.slot.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      front_pipeline(pass, context, bodies[tile.body]));
    push_constants(context, std::as_bytes(std::span(&tile.constants, 1)));
    draw_vertices(context, upload.bodies[tile.body].surface, upload.bodies[tile.body].surface_count);
  }
}

void copy_surroundings(const IcePass& pass, PassContext& context) {
  const std::uint32_t side = pass.targets.cube.description.width;
  const bool multisampled = pass.targets.around.description.samples != VK_SAMPLE_COUNT_1_BIT;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const VkOffset3D from{std::int32_t(i % 3 * side), std::int32_t(i / 3 * side), 0};
    const VkImageSubresourceLayers source{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
        target{VK_IMAGE_ASPECT_COLOR_BIT, 0, i, 1};
    const VkImageResolve resolve{source, from, target, {}, {side, side, 1}};
    const VkImageCopy copy{source, from, target, {}, {side, side, 1}};
    if (multisampled)
      vkCmdResolveImage(context.slot.commands, pass.targets.around.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                        pass.targets.cube.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &resolve);
    else
      vkCmdCopyImage(context.slot.commands, pass.targets.around.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                     pass.targets.cube.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
  }
}

}  // namespace septet::render

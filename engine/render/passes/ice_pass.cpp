#include "engine/render/passes/ice_pass.hpp"

#include <algorithm>
#include <array>

#include "engine/effects/ice/cracks.hpp"
#include "engine/render/passes/shaders.hpp"

namespace septet::render {
namespace {

constexpr VkFormat layer_format = VK_FORMAT_R32G32B32A32_SFLOAT, inside_format = VK_FORMAT_R16G16B16A16_SFLOAT;

void destroy_ice_targets(IcePass& pass, vulkan::MemoryPool& memory) {
  for (vulkan::DeviceImage& image : pass.targets.images) destroy_image(memory, image);
  pass.targets = {};
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

/// Pipeline of a layer; `peel` and `followed` as in shaders/ice_layer.frag.
VkPipeline layer_pipeline(IcePass& pass, PassContext& context, std::uint32_t peel, bool followed) {
  VkPipeline& pipeline = pass.layers[2 * peel + std::uint32_t{followed}];
  if (pipeline) return pipeline;
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::ice_layer_vert();
  description.fragment_code = shaders::ice_layer_frag();
  description.vertex_input = vulkan::VertexInput::ice;
  description.color_format = layer_format;
  description.depth_format = context.formats.depth;
  description.blend = vulkan::Blend::data;
  description.constants = {peel, followed};
  return pipeline = create_pipeline(context.device, context.layout, description);
}

/// Pipeline of cracks nearer than the back face, drawn over its normal; its depth, the fourth number, stays.
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

/// Pipeline of the inside; `kind` as in shaders/ice_inside.frag.
VkPipeline inside_pipeline(IcePass& pass, PassContext& context, bool quality, std::uint32_t kind) {
  VkPipeline& pipeline = pass.insides[std::uint32_t{quality} | kind << 1];
  if (pipeline) return pipeline;
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::ice_inside_vert();
  description.fragment_code = shaders::ice_inside_frag();
  description.vertex_input = vulkan::VertexInput::ice;
  description.color_format = inside_format;
  description.depth_write = false;
  description.blend = vulkan::Blend::layer;
  description.constants = {quality, kind};
  return pipeline = create_pipeline(context.device, context.layout, description);
}

VkPipeline front_pipeline(IcePass& pass, PassContext& context, const ice::IceBody& body) {
  const bool quality = body.look.mode == ice::Mode::quality;
  const std::array<std::uint32_t, 7> constants{quality,
                                               body.look.two_sided,
                                               !body.inside.empty(),
                                               body.look.roughness > 0.0f,
                                               quality && body.look.seen_beyond,
                                               std::uint32_t(body.look.shown),
                                               body.look.thin};
  std::uint32_t variant = 0;
  for (const std::uint32_t constant : constants) variant = variant << 2 | constant;
  VkPipeline& pipeline = pass.fronts[variant];
  if (pipeline) return pipeline;
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::ice_vert();
  description.fragment_code = shaders::ice_frag();
  description.vertex_input = vulkan::VertexInput::ice;
  description.color_format = context.formats.radiance;
  description.marks = context.formats.marks;
  description.depth_format = context.formats.depth;
  description.samples = context.formats.samples;
  if (body.look.thin) description.blend = vulkan::Blend::over;
  std::ranges::copy(constants, description.constants.begin());
  return pipeline = create_pipeline(context.device, context.layout, description);
}

void begin_layer(PassContext& context, const IceTargets& targets, IceImage layer, const IceTiles& tiles) {
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = targets[layer].view;
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  depth.imageView = targets[IceImage::depth].view;
  depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  const std::uint32_t coarser = layer == IceImage::inside ? 2 : 1;
  rendering.renderArea = {{0, 0},
                          {(tiles.used_width + coarser - 1) / coarser, (tiles.used_height + coarser - 1) / coarser}};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  if (layer != IceImage::inside) rendering.pDepthAttachment = &depth;
  vkCmdBeginRendering(context.slot.commands, &rendering);
  set_viewport(context, {0, 0, targets[layer].description.width, targets[layer].description.height});
  vkCmdSetFrontFace(context.slot.commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
}

/// Begins a body's rectangle. `coarser`: width of a pixel of this layer in pixels of the other layers.
void begin_tile(PassContext& context, const IceTile& tile, std::int32_t coarser = 1) {
  const auto& [x, y, width, height] = tile.rectangle;
  const std::int32_t left = x / coarser, top = y / coarser;
  const auto past = [&](std::int32_t low, std::uint32_t size) {
    return (low + std::int32_t(size) + coarser - 1) / coarser;
  };
  const VkRect2D scissor{{left, top}, {std::uint32_t(past(x, width) - left), std::uint32_t(past(y, height) - top)}};
  vkCmdSetScissor(context.slot.commands, 0, 1, &scissor);
  push_constants(context, std::as_bytes(std::span(&tile.constants, 1)));
}

void bind(PassContext& context, VkPipeline pipeline) {
  vkCmdBindPipeline(context.slot.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
}

void draw_inside(IcePass& pass, PassContext& context, const IceTiles& tiles, std::span<const ice::IceBody> bodies,
                 const IceUpload& upload) {
  push_layer(context, vulkan::binding_ice_back, pass.targets[IceImage::back].view);
  vkCmdSetCullMode(context.slot.commands, VK_CULL_MODE_NONE);
  for (const IceTile& tile : tiles.list) {
    const IceUpload::Vertices& vertices = upload.bodies[tile.body];
    if (vertices.inside_count == 0) continue;
    const bool quality = bodies[tile.body].look.mode == ice::Mode::quality;
    begin_tile(context, tile, 2);
    push_layer(context, vulkan::binding_surroundings, pass.targets[cube_of(tile.around)].view);
    bind(context, inside_pipeline(pass, context, quality, vertices.mixed ? 0 : 1));
    draw_vertices(context, vertices.inside, vertices.first_air);
    bind(context, inside_pipeline(pass, context, quality, 2));
    draw_vertices(context, vertices.inside, vertices.inside_count - vertices.first_air, vertices.first_air);
  }
}

void draw_faces(IcePass& pass, PassContext& context, IceImage layer, const IceTiles& tiles,
                std::span<const ice::IceBody> bodies, const IceUpload& upload) {
  vkCmdSetCullMode(context.slot.commands, layer == IceImage::front ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_FRONT_BIT);
  for (const IceTile& tile : tiles.list) {
    bind(context, layer_pipeline(pass, context, 0, bodies[tile.body].look.mode == ice::Mode::quality));
    begin_tile(context, tile);
    draw_vertices(context, upload.bodies[tile.body].surface, upload.bodies[tile.body].surface_count);
  }
}

void draw_bending_cracks(IcePass& pass, PassContext& context, const IceTiles& tiles,
                         std::span<const ice::IceBody> bodies, const IceUpload& upload) {
  vkCmdSetCullMode(context.slot.commands, VK_CULL_MODE_NONE);
  for (const IceTile& tile : tiles.list) {
    const ice::Look& look = bodies[tile.body].look;
    const IceUpload::Vertices& vertices = upload.bodies[tile.body];
    if (look.mode != ice::Mode::quality || !look.bent_by_cracks || vertices.inside_count == 0) continue;
    bind(context, crack_pipeline(pass, context));
    begin_tile(context, tile);
    draw_vertices(context, vertices.inside, vertices.inside_count);
  }
}

void draw_beyond(IcePass& pass, PassContext& context, IceImage layer, const IceTiles& tiles,
                 std::span<const ice::IceBody> bodies, const IceUpload& upload) {
  const bool front = layer == IceImage::beyond;
  if (front)
    push_layer(context, vulkan::binding_ice_back, pass.targets[IceImage::back].view);
  else
    push_layer(context, vulkan::binding_ice_beyond, pass.targets[IceImage::beyond].view);
  vkCmdSetCullMode(context.slot.commands, front ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_FRONT_BIT);
  bind(context, layer_pipeline(pass, context, front ? 1 : 2, true));
  for (const IceTile& tile : tiles.list) {
    if (tile.constants.beyond.x == 0.0f) continue;
    begin_tile(context, tile);
    draw_vertices(context, upload.bodies[tile.body].surface, upload.bodies[tile.body].surface_count);
    for (const std::uint32_t other : tile.beyond) {
      const IceConstants constants = constants_beyond(tile, bodies[tile.body], bodies[other]);
      push_constants(context, std::as_bytes(std::span(&constants, 1)));
      draw_vertices(context, upload.bodies[other].surface, upload.bodies[other].surface_count);
    }
  }
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

bool ice_targets_fit(const IcePass& pass, const IceTargetSizes& sizes) {
  const vulkan::ImageDescription& layer = pass.targets[IceImage::front].description;
  return layer.width == sizes.width && layer.height == sizes.height &&
         pass.targets[IceImage::cube].description.width == sizes.surroundings_px &&
         pass.targets[cube_of(sizes.surroundings - 1)].image && (!sizes.beyond || pass.targets[IceImage::beyond].image);
}

void prepare_ice_targets(IcePass& pass, PassContext& context, const IceTargetSizes& sizes) {
  if (ice_targets_fit(pass, sizes)) return;
  destroy_ice_targets(pass, context.memory);
  IceTargets& targets = pass.targets;
  vulkan::ImageDescription description;
  const auto make = [&](IceImage which) { targets[which] = create_image(context.memory, description); };
  description.width = sizes.width;
  description.height = sizes.height;
  description.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  description.format = layer_format;
  make(IceImage::front), make(IceImage::back);
  if (sizes.beyond) make(IceImage::beyond), make(IceImage::beyond_back);
  description.format = inside_format;
  description.width = sizes.width / 2;
  description.height = sizes.height / 2;
  make(IceImage::inside);
  description.width = sizes.width;
  description.height = sizes.height;
  description.format = context.formats.depth;
  description.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  description.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
  make(IceImage::depth);
  description.width = 3 * sizes.surroundings_px;
  description.height = 2 * sizes.surroundings_px;
  description.samples = context.formats.samples;
  make(IceImage::around_depth);
  description.aspect = VK_IMAGE_ASPECT_COLOR_BIT;
  description.format = context.formats.radiance;
  description.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  make(IceImage::around);
  description.width = description.height = sizes.surroundings_px;
  description.samples = VK_SAMPLE_COUNT_1_BIT;
  description.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  description.layers = 6;
  description.cube = true;
  for (std::uint32_t i = 0; i < sizes.surroundings; ++i) make(cube_of(i));
}

void destroy_ice_pass(IcePass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory) {
  destroy_ice_targets(pass, memory);
  for (const auto& pipelines : {pass.fronts, pass.insides})
    for (const auto& [key, pipeline] : pipelines)
      if (pipeline) vkDestroyPipeline(device.device, pipeline, nullptr);
  for (const VkPipeline pipeline : pass.layers)
    if (pipeline) vkDestroyPipeline(device.device, pipeline, nullptr);
  for (const VkPipeline pipeline : {pass.cracks, pass.glass[0], pass.glass[1]})
    if (pipeline) vkDestroyPipeline(device.device, pipeline, nullptr);
  pass = {};
}

void draw_ice_layer(IcePass& pass, PassContext& context, IceImage layer, const IceTiles& tiles,
                    std::span<const ice::IceBody> bodies, const IceUpload& upload, const ViewBindings& bindings) {
  begin_layer(context, pass.targets, layer, tiles);
  push_view(context, bindings);
  if (layer != IceImage::front) push_layer(context, vulkan::binding_ice_front, pass.targets[IceImage::front].view);
  // Each layer reads some of the shader's bindings; all of them must be bound.
  for (const std::uint32_t unused : {vulkan::binding_ice_back, vulkan::binding_ice_beyond})
    push_layer(context, unused, bindings.noise);
  switch (layer) {
    case IceImage::inside:
      draw_inside(pass, context, tiles, bodies, upload);
      break;
    case IceImage::beyond:
    case IceImage::beyond_back:
      draw_beyond(pass, context, layer, tiles, bodies, upload);
      break;
    default:
      draw_faces(pass, context, layer, tiles, bodies, upload);
      if (layer == IceImage::back) draw_bending_cracks(pass, context, tiles, bodies, upload);
  }
  vkCmdEndRendering(context.slot.commands);
}

void draw_ice(IcePass& pass, PassContext& context, const IceTiles& tiles, std::uint32_t view,
              std::span<const ice::IceBody> bodies, const IceUpload& upload) {
  if (std::ranges::none_of(tiles.list, [&](const IceTile& tile) { return tile.view == view; })) return;
  const IceTargets& targets = pass.targets;
  push_layer(context, vulkan::binding_ice_front, targets[IceImage::front].view);
  push_layer(context, vulkan::binding_ice_back, targets[IceImage::back].view);
  push_layer(context, vulkan::binding_ice_inside, targets[IceImage::inside].view);
  push_layer(context, vulkan::binding_ice_beyond, targets[tiles.beyond ? IceImage::beyond : IceImage::front].view);
  push_layer(context, vulkan::binding_ice_beyond_back,
             targets[tiles.beyond ? IceImage::beyond_back : IceImage::back].view);
  vkCmdSetCullMode(context.slot.commands, VK_CULL_MODE_BACK_BIT);
  for (const IceTile& tile : tiles.list) {
    if (tile.view != view) continue;
    vkCmdBindPipeline(context.slot.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      front_pipeline(pass, context, bodies[tile.body]));
    push_layer(context, vulkan::binding_surroundings, targets[cube_of(tile.around)].view);
    push_constants(context, std::as_bytes(std::span(&tile.constants, 1)));
    draw_vertices(context, upload.bodies[tile.body].surface, upload.bodies[tile.body].surface_count);
  }
}

void copy_surroundings(const IcePass& pass, PassContext& context, IceImage cube) {
  const std::uint32_t side = pass.targets[cube].description.width;
  const bool multisampled = pass.targets[IceImage::around].description.samples != VK_SAMPLE_COUNT_1_BIT;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const VkOffset3D from{std::int32_t(i % 3 * side), std::int32_t(i / 3 * side), 0};
    const VkImageSubresourceLayers source{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
        target{VK_IMAGE_ASPECT_COLOR_BIT, 0, i, 1};
    const VkImageResolve resolve{source, from, target, {}, {side, side, 1}};
    const VkImageCopy copy{source, from, target, {}, {side, side, 1}};
    if (multisampled)
      vkCmdResolveImage(context.slot.commands, pass.targets[IceImage::around].image,
                        VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pass.targets[cube].image,
                        VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &resolve);
    else
      vkCmdCopyImage(context.slot.commands, pass.targets[IceImage::around].image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                     pass.targets[cube].image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
  }
}

}  // namespace septet::render

#include "engine/render/passes/surface_pass.hpp"

#include <algorithm>

#include "engine/render/passes/shaders.hpp"

namespace septet::render {
namespace {

/// Properties that the pipeline of a material is specialised for.
struct Variant {
  std::uint32_t textured;  ///< See shaders/surface.frag.
  std::uint32_t lamps;     ///< See shaders/surface.frag.
  std::uint32_t glossy;    ///< See shaders/surface.frag.
  bool unshaded, snowy, sooty, road, mirror, fading, retroreflective, moving, two_sided, in_street, smoke_shaded;
  SurfaceKind kind;
  std::uint32_t maps, square_roots, second_uv;  ///< Of its material.
  std::uint32_t key() const {
    return textured | (lamps & 7u) << 2 | (lamps >> 3) << 18 | glossy << 5 | std::uint32_t{snowy} << 7 |
           std::uint32_t{sooty} << 8 | static_cast<std::uint32_t>(kind) << 9 | std::uint32_t{road} << 11 |
           std::uint32_t{mirror} << 12 | std::uint32_t{fading} << 13 | std::uint32_t{retroreflective} << 14 |
           std::uint32_t{moving} << 15 | std::uint32_t{unshaded} << 16 | std::uint32_t{two_sided} << 17 |
           std::uint32_t{in_street} << 19 | maps << 20 | square_roots << 23 | second_uv << 27 |
           std::uint32_t{smoke_shaded} << 31;
  }
};

SurfaceKind kind_of(const DeviceMaterial& material) {
  if (material.stripe) return SurfaceKind::stripe;
  return material.blended ? SurfaceKind::blended : material.cut ? SurfaceKind::cut : SurfaceKind::opaque;
}

VkPipeline pipeline_of(SurfacePass& pass, PassContext& context, const Variant& variant) {
  VkPipeline& pipeline = pass.pipelines[variant.key()];
  if (pipeline) return pipeline;
  const bool multisampled = context.formats.samples != VK_SAMPLE_COUNT_1_BIT;
  const bool cut = variant.kind == SurfaceKind::cut, stripe = variant.kind == SurfaceKind::stripe,
             blended = stripe || variant.kind == SurfaceKind::blended;
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::surface_vert();
  description.fragment_code = shaders::surface_frag();
  description.color_format = context.formats.radiance;
  description.depth_format = context.formats.depth;
  description.samples = context.formats.samples;
  // In a puddle, transparent surfaces are drawn opaque.
  description.blend = variant.mirror ? vulkan::Blend::data : blended ? vulkan::Blend::over : vulkan::Blend::none;
  description.depth_write = variant.mirror || !blended;
  // Static stripes and panes keep the marks of the surfaces behind them.
  description.marks = context.formats.marks && (variant.moving || !blended);
  description.alpha_to_coverage = cut && multisampled;
  description.constants = {variant.textured,
                           cut ? (multisampled ? 1u : 2u) : 0u,
                           variant.glossy,
                           blended,
                           variant.lamps,
                           variant.snowy,
                           variant.sooty,
                           stripe,
                           variant.road,
                           variant.mirror,
                           variant.fading,
                           variant.retroreflective,
                           !context.formats.marks ? 0u
                           : variant.moving       ? 2u
                                                  : 1u};
  description.constants[shaders::clustered_headlights_constant] = context.refinements.clustered_headlights;
  description.constants[shaders::unshaded_constant] = variant.unshaded;
  description.constants[shaders::two_sided_constant] = variant.two_sided;
  description.constants[shaders::in_street_constant] = variant.in_street;
  description.constants[shaders::smoke_shade_constant] = variant.smoke_shaded;
  description.constants[shaders::maps_constant] = variant.maps;
  description.constants[shaders::square_roots_constant] = variant.square_roots;
  description.constants[shaders::second_uv_constant] = variant.second_uv;
  description.constants[shaders::soft_shadows_constant] = context.refinements.soft_shadows;
  pipeline = create_pipeline(context.device, context.layout, description);
  return pipeline;
}

}  // namespace

void destroy_surface_pass(SurfacePass& pass, const vulkan::Device& device) {
  for (const auto& [key, pipeline] : pass.pipelines)
    if (pipeline) vkDestroyPipeline(device.device, pipeline, nullptr);
  pass.pipelines.clear();
}

void draw_surfaces(SurfacePass& pass, PassContext& context, const DeviceScene& scene, const SurfaceDraws& draws,
                   SurfaceKind kind, const SurfaceLight& light) {
  const VkCommandBuffer commands = context.slot.commands;
  bool culls = kind == SurfaceKind::opaque;
  vkCmdSetCullMode(commands, culls ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE);
  VkPipeline bound_pipeline = VK_NULL_HANDLE;
  std::int32_t bound_image = -1;
  scene::SurfaceMapImages bound_maps = scene::no_surface_maps;
  std::uint32_t bound_material = no_group;
  SurfaceDraw bound;
  const auto draw_one = [&](const SurfaceDraw& draw) {
    const DeviceMaterial& material = scene.materials[draw.material];
    if (kind_of(material) != kind) return;
    const bool textured = material.image >= 0;
    const std::uint32_t texturing = !textured ? 0 : material.wettable && !context.samplers.anisotropic ? 2 : 1;
    const std::uint32_t glossy =
        std::uint32_t{material.glossy || (light.wet && material.wettable)} | std::uint32_t{material.coated} << 1;
    const bool moving = context.formats.marks && !draw.still;
    const bool retroreflective = material.constants.light.y > 0.0f;
    const VkPipeline pipeline =
        pipeline_of(pass, context,
                    {texturing, light.lamps(), glossy, light.unshaded, light.snowy, light.sooty, material.wettable,
                     light.mirror_of_road, draw.fading, retroreflective, moving, material.two_sided, material.in_street,
                     light.smoke_shaded, kind, material.map_bits, material.square_root_bits, material.second_uv_bits});
    if (pipeline != bound_pipeline) vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    bound_pipeline = pipeline;
    if (const bool culled = kind == SurfaceKind::opaque && !material.two_sided; culled != culls)
      vkCmdSetCullMode(commands, (culls = culled) ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE);
    if (textured && material.image != bound_image) {
      const DeviceTexture& texture = scene.textures[static_cast<std::size_t>(material.image)];
      push_image(context, texture.image.view,
                 material.wettable ? context.samplers.road : context.samplers.of(texture.sampling));
      bound_image = material.image;
    }
    for (std::uint32_t map = 0; material.map_bits >> map != 0; ++map)
      if (const std::int32_t image = material.maps.values[map]; image >= 0 && image != bound_maps.values[map]) {
        const DeviceTexture& texture = scene.textures[static_cast<std::size_t>(image)];
        push_image(context, texture.image.view, context.samplers.of(texture.sampling),
                   vulkan::binding_emission_map + map);
        bound_maps.values[map] = image;
      }
    if (draw.material != bound_material) push_constants(context, std::as_bytes(std::span(&material.constants, 1)));
    bound_material = draw.material;
    if (kind != SurfaceKind::blended || !material.two_sided) return record_draw(context, draw, bound);
    // Of what is seen through, the far side first.
    for (const VkCullModeFlags side : {VK_CULL_MODE_FRONT_BIT, VK_CULL_MODE_BACK_BIT}) {
      vkCmdSetCullMode(commands, side);
      record_draw(context, draw, bound);
    }
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
  };
  if (kind == SurfaceKind::blended)
    std::for_each(draws.list.rbegin(), draws.list.rend(), draw_one);
  else
    std::for_each(draws.list.begin(), draws.list.end(), draw_one);
}

}  // namespace septet::render

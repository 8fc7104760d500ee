#include "engine/render/passes/bloom_pass.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "engine/render/passes/shaders.hpp"
#include "engine/render/passes/whole_target.hpp"

namespace septet::render {
namespace {

/// Share of a level that comes from the smaller level; the rest is its own, so that skirts twice as wide have 0.6 of
/// the light each time.
constexpr float share_of_wider = 0.6f;
/// Share of its light that a pixel gives away: a healthy eye scatters some hundredths (Vos, "On the cause of disability
/// glare", 1984).
constexpr float share_of_radiance = 0.03f;

constexpr std::array<const char*, bloom_levels> level_names{"bloom, 1/2", "bloom, 1/4", "bloom, 1/8", "bloom, 1/16",
                                                            "bloom, 1/32"};

/// Size of a texel of the source and of one of the target, in texture coordinates.
glm::vec4 texels(const vulkan::DeviceImage& source, const vulkan::DeviceImage& target) {
  return 1.0f / glm::vec4(source.description.width, source.description.height, target.description.width,
                          target.description.height);
}

}  // namespace

void create_bloom_pass(BloomPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                       const TargetFormats& formats) {
  const bool multisampled = formats.samples != VK_SAMPLE_COUNT_1_BIT;
  const auto make = [&](std::span<const std::uint32_t> code, vulkan::Blend blend, VkSampleCountFlagBits samples) {
    return create_whole_target_pipeline(device, layout, formats.radiance, code, blend, samples);
  };
  pass.down = make(shaders::bloom_down_frag(), vulkan::Blend::none, VK_SAMPLE_COUNT_1_BIT);
  pass.first = make(multisampled ? shaders::bloom_down_samples_frag() : shaders::bloom_down_frag(), vulkan::Blend::none,
                    VK_SAMPLE_COUNT_1_BIT);
  pass.up = make(shaders::bloom_up_frag(), vulkan::Blend::over, VK_SAMPLE_COUNT_1_BIT);
  pass.last = make(shaders::bloom_up_frag(), vulkan::Blend::over, formats.samples);
}

void create_bloom_targets(BloomPass& pass, vulkan::MemoryPool& memory, const TargetFormats& formats,
                          std::uint32_t width, std::uint32_t height) {
  vulkan::ImageDescription description;
  description.format = formats.radiance;
  description.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  for (std::size_t i = 0; i < bloom_levels; ++i) {
    description.width = std::max(1u, width >> (i + 1));
    description.height = std::max(1u, height >> (i + 1));
    pass.images[i] = create_image(memory, description);
  }
  pass.accesses.fill(Access::none);
}

void destroy_bloom_targets(BloomPass& pass, vulkan::MemoryPool& memory) {
  for (vulkan::DeviceImage& image : pass.images) destroy_image(memory, image);
}

void destroy_bloom_pass(BloomPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory) {
  for (const VkPipeline pipeline : {pass.first, pass.down, pass.up, pass.last})
    if (pipeline) vkDestroyPipeline(device.device, pipeline, nullptr);
  destroy_bloom_targets(pass, memory);
  pass = {};
}

void add_bloom_passes(FrameGraph& graph, BloomPass& pass, PassContext& context, ResourceId radiance,
                      const vulkan::DeviceImage& target) {
  std::array<ResourceId, bloom_levels> levels{};
  for (std::size_t i = 0; i < bloom_levels; ++i)
    levels[i] = graph.add_image(level_names[i], pass.images[i], pass.accesses[i]);
  for (std::size_t i = 0; i < bloom_levels; ++i) {
    const ResourceId from = i == 0 ? radiance : levels[i - 1];
    graph.add_pass("bloom, down", {{{from, Access::sampled}}, {{levels[i], Access::color_attachment}}},
                   [&pass, &context, &target, i] {
                     const vulkan::DeviceImage &source = i == 0 ? target : pass.images[i - 1], &level = pass.images[i];
                     draw_whole_target(i == 0 ? pass.first : pass.down, context, source.view, level.view,
                                       level.description.width, level.description.height, texels(source, level));
                   });
  }
  const auto mix_up = [&](ResourceId from, ResourceId to, VkPipeline pipeline, const vulkan::DeviceImage& source,
                          const vulkan::DeviceImage& larger, float share) {
    graph.add_pass("bloom, up",
                   {{{from, Access::sampled}, {to, Access::color_attachment}}, {{to, Access::color_attachment}}},
                   [&context, &source, &larger, pipeline, share] {
                     const auto [width, height] = std::pair(larger.description.width, larger.description.height);
                     draw_over_whole_target(pipeline, context, source.view, larger.view, width, height,
                                            glm::vec4(width, height, share, 0.0f));
                     mark_pass(context, "bloom");
                   });
  };
  for (std::size_t i = bloom_levels - 1; i > 0; --i)
    mix_up(levels[i], levels[i - 1], pass.up, pass.images[i], pass.images[i - 1], share_of_wider);
  mix_up(levels[0], radiance, pass.last, pass.images[0], target, share_of_radiance);
}

}  // namespace septet::render

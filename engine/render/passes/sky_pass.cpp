#include "engine/render/passes/sky_pass.hpp"

#include <algorithm>
#include <cmath>

#include <glm/gtc/packing.hpp>

#include "engine/render/passes/shaders.hpp"

namespace septet::render {
namespace {

/// A number in [0, 1) for a lattice point: an integer hash.
float lattice(std::uint32_t x, std::uint32_t y, std::uint32_t octave) {
  std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ octave * 0xc2b2ae3du;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) / 16777216.0f;
}

float value_noise(float x, float y, std::uint32_t period, std::uint32_t octave) {
  const auto x0 = static_cast<std::uint32_t>(x), y0 = static_cast<std::uint32_t>(y);
  const auto ease = [](float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); };
  const float u = ease(x - static_cast<float>(x0)), v = ease(y - static_cast<float>(y0));
  const std::uint32_t x1 = (x0 + 1) % period, y1 = (y0 + 1) % period;
  const float top = std::lerp(lattice(x0, y0, octave), lattice(x1, y0, octave), u);
  const float bottom = std::lerp(lattice(x0, y1, octave), lattice(x1, y1, octave), u);
  return std::lerp(top, bottom, v);
}

}  // namespace

void destroy_sky_pass(SkyPass& pass, const vulkan::Device& device) {
  for (const VkPipeline pipeline : pass.pipelines)
    if (pipeline) vkDestroyPipeline(device.device, pipeline, nullptr);
  pass = {};
}

void draw_sky(SkyPass& pass, PassContext& context, bool clouded, bool starry) {
  VkPipeline& pipeline = pass.pipelines[std::size_t{clouded} + 2 * std::size_t{starry}];
  if (!pipeline) {
    vulkan::PipelineDescription description;
    description.vertex_code = shaders::sky_vert();
    description.fragment_code = shaders::sky_frag();
    description.vertex_input = vulkan::VertexInput::none;
    description.color_format = context.formats.color;
    description.depth_format = context.formats.depth;
    description.samples = context.formats.samples;
    description.depth_write = false;  // At depth 0 it passes only where the depth is still cleared.
    description.constants = {clouded, starry};
    pipeline = create_pipeline(context.device, context.layout, description);
  }
  vkCmdSetCullMode(context.slot.commands, VK_CULL_MODE_NONE);
  vkCmdBindPipeline(context.slot.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  vkCmdDraw(context.slot.commands, 3, 1, 0, 0);
  ++context.statistics.draws;
  ++context.statistics.triangles;
}

std::vector<std::uint64_t> packed(const SkyTable& table) {
  std::vector<std::uint64_t> texels;
  texels.reserve(table.radiance.size());
  for (const glm::vec3& radiance : table.radiance) texels.push_back(glm::packHalf4x16(glm::vec4(radiance, 1.0f)));
  return texels;
}

std::vector<std::uint8_t> cloud_noise() {
  std::vector<float> sum(noise_side * noise_side, 0.0f);
  std::uint32_t period = 4;
  float weight = 0.5f;
  for (std::uint32_t octave = 0; octave < 6; ++octave, period *= 2, weight *= 0.55f)
    for (std::uint32_t y = 0; y < noise_side; ++y)
      for (std::uint32_t x = 0; x < noise_side; ++x)
        sum[y * noise_side + x] += weight * value_noise(static_cast<float>(x * period) / noise_side,
                                                        static_cast<float>(y * period) / noise_side, period, octave);
  // Each value becomes its rank, so that a share c of the tile lies above 1 − c.
  const auto [low, high] = std::minmax_element(sum.begin(), sum.end());
  constexpr std::size_t bins = 4096;
  const float least = *low, scale = (bins - 1) / (*high - *low);
  const auto bin = [&](float value) { return static_cast<std::size_t>((value - least) * scale); };
  std::vector<std::uint32_t> below(bins + 1, 0);
  for (const float value : sum) ++below[bin(value) + 1];
  for (std::size_t i = 1; i <= bins; ++i) below[i] += below[i - 1];
  std::vector<std::uint8_t> rgba;
  rgba.reserve(sum.size() * 4);
  for (const float value : sum)
    rgba.insert(rgba.end(), 4, static_cast<std::uint8_t>(std::uint64_t{255} * below[bin(value)] / sum.size()));
  return rgba;
}

}  // namespace septet::render

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

void create_sky_pass(SkyPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                     const TargetFormats& formats) {
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::sky_vert();
  description.fragment_code = shaders::sky_frag();
  description.vertex_input = vulkan::VertexInput::none;
  description.color_format = formats.color;
  description.depth_format = formats.depth;
  description.samples = formats.samples;
  description.depth_write = false;  // At depth 0 it passes only where the depth is still cleared.
  pass.pipeline = create_pipeline(device, layout, description);
}

void destroy_sky_pass(SkyPass& pass, const vulkan::Device& device) {
  if (pass.pipeline) vkDestroyPipeline(device.device, pass.pipeline, nullptr);
  pass = {};
}

void draw_sky(const SkyPass& pass, PassContext& context) {
  vkCmdSetCullMode(context.slot.commands, VK_CULL_MODE_NONE);
  vkCmdBindPipeline(context.slot.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pass.pipeline);
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
  for (std::uint32_t octave = 0; octave < 5; ++octave, period *= 2, weight *= 0.5f)
    for (std::uint32_t y = 0; y < noise_side; ++y)
      for (std::uint32_t x = 0; x < noise_side; ++x)
        sum[y * noise_side + x] += weight * value_noise(static_cast<float>(x * period) / noise_side,
                                                        static_cast<float>(y * period) / noise_side, period, octave);
  // Spread over the whole range.
  const auto [low, high] = std::minmax_element(sum.begin(), sum.end());
  const float least = *low, span = *high - *low;
  std::vector<std::uint8_t> rgba;
  rgba.reserve(sum.size() * 4);
  for (const float value : sum)
    rgba.insert(rgba.end(), 4, static_cast<std::uint8_t>(255.0f * (value - least) / span + 0.5f));
  return rgba;
}

}  // namespace septet::render

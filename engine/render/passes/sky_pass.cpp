#include "engine/render/passes/sky_pass.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
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

/// Adds value noise with `period` cells along each side of the tile.
void add_octave(std::vector<float>& sum, std::uint32_t period, std::uint32_t octave, float weight) {
  std::vector<float> corners(std::size_t{period} * period);
  for (std::uint32_t y = 0; y < period; ++y)
    for (std::uint32_t x = 0; x < period; ++x) corners[y * period + x] = weight * lattice(x, y, octave);
  const auto ease = [](float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); };
  struct Column {
    std::uint32_t left, right;
    float share;
  };
  std::vector<Column> columns(noise_side);
  for (std::uint32_t x = 0; x < noise_side; ++x) {
    const float at = static_cast<float>(x * period) / noise_side;
    const auto left = static_cast<std::uint32_t>(at);
    columns[x] = {left, (left + 1) % period, ease(at - static_cast<float>(left))};
  }
  for (std::uint32_t y = 0; y < noise_side; ++y) {
    const Column& row = columns[y];  // The tile is square: rows lie as columns do.
    const float *top = &corners[row.left * period], *bottom = &corners[row.right * period];
    for (std::uint32_t x = 0; x < noise_side; ++x) {
      const Column& column = columns[x];
      const float above = glm::mix(top[column.left], top[column.right], column.share);
      const float below = glm::mix(bottom[column.left], bottom[column.right], column.share);
      sum[y * noise_side + x] += glm::mix(above, below, row.share);
    }
  }
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
    description.color_format = context.formats.radiance;
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
    add_octave(sum, period, octave, weight);
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

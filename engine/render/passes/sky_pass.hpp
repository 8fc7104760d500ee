#pragma once
/// Draws the sky where nothing else was drawn: the table's light, clouds, sun and stars.

#include "engine/render/atmosphere.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct SkyPass {
  VkPipeline pipeline = VK_NULL_HANDLE;
};

void create_sky_pass(SkyPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                     const TargetFormats& formats);
void destroy_sky_pass(SkyPass& pass, const vulkan::Device& device);
void draw_sky(const SkyPass& pass, PassContext& context);

/// The table as half floats, RGBA, for a texture of SkyTable's size.
std::vector<std::uint64_t> packed(const SkyTable& table);

/// A tile of noise for clouds: five octaves of value noise, 8 bits, RGBA alike, that repeats at its edges.
inline constexpr std::uint32_t noise_side = 256;
std::vector<std::uint8_t> cloud_noise();

}  // namespace septet::render

#pragma once
/// Draws the sky where nothing else was drawn: the table's light, clouds, sun and stars.

#include <array>
#include <vector>

#include "engine/instant/atmosphere.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct SkyPass {
  std::array<VkPipeline, 4> pipelines{};  ///< By clouds and stars; made when first drawn.
};

void destroy_sky_pass(SkyPass& pass, const vulkan::Device& device);
void draw_sky(SkyPass& pass, PassContext& context, bool clouded, bool starry);

/// The table as half floats, RGBA, for a texture of SkyTable's size.
std::vector<std::uint64_t> packed(const SkyTable& table);

}  // namespace septet::render

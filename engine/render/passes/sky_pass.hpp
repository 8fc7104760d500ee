#pragma once
/// Draws the sky behind all surfaces: the table's light, clouds, sun and stars.

#include <array>
#include <vector>

#include "engine/instant/atmosphere.hpp"
#include "engine/instant/sky_by_roughness.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct SkyPass {
  std::array<VkPipeline, 4> pipelines{};  ///< Indexed by clouds and stars; created at first use.
};

void destroy_sky_pass(SkyPass& pass, const vulkan::Device& device);
void draw_sky(SkyPass& pass, PassContext& context, bool clouded, bool starry);

/// Rows of the sky's texture: the table, and below it one for each step of roughness (instant/sky_by_roughness.hpp).
inline constexpr std::uint32_t sky_rows = SkyTable::rows * (1 + light::roughness_steps);
/// Packs the light as half floats, RGBA, for a texture of SkyTable's columns and of `sky_rows`.
std::vector<std::uint64_t> packed(const SkyLight& light);

}  // namespace septet::render

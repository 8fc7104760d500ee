#pragma once
/// SPIR-V of engine/render/shaders, compiled by glslc at build time and embedded.

#include <cstddef>
#include <cstdint>
#include <span>

namespace septet::render::shaders {

/// Specialization constant of shaders/surface.frag, as are two_sided_constant, in_street_constant, maps_constant,
/// square_roots_constant, second_uv_constant and smoke_shade_constant.
inline constexpr std::size_t clustered_headlights_constant = 14;
/// Specialization constant of shaders/sunlit.glsl, as is soft_shadows_constant.
inline constexpr std::size_t unshaded_constant = 13;
inline constexpr std::size_t two_sided_constant = 16;
inline constexpr std::size_t in_street_constant = 17;
inline constexpr std::size_t maps_constant = 18;
inline constexpr std::size_t square_roots_constant = 19;
inline constexpr std::size_t second_uv_constant = 20;
inline constexpr std::size_t soft_shadows_constant = 15;
inline constexpr std::size_t smoke_shade_constant = 21;

std::span<const std::uint32_t> surface_vert();
std::span<const std::uint32_t> surface_frag();
std::span<const std::uint32_t> shadow_vert();
std::span<const std::uint32_t> shadow_cut_frag();
std::span<const std::uint32_t> shadow_fade_frag();
std::span<const std::uint32_t> sky_vert();
std::span<const std::uint32_t> sky_frag();
std::span<const std::uint32_t> glow_vert();
std::span<const std::uint32_t> glow_frag();
std::span<const std::uint32_t> smoke_vert();
std::span<const std::uint32_t> smoke_frag();
std::span<const std::uint32_t> precipitation_vert();
std::span<const std::uint32_t> precipitation_frag();
std::span<const std::uint32_t> contact_vert();
std::span<const std::uint32_t> contact_frag();
std::span<const std::uint32_t> mirror_glass_vert();
std::span<const std::uint32_t> mirror_glass_frag();
std::span<const std::uint32_t> wet_lamp_vert();
std::span<const std::uint32_t> wet_lamp_frag();
std::span<const std::uint32_t> whole_target_vert();
std::span<const std::uint32_t> bloom_down_frag();
std::span<const std::uint32_t> bloom_down_samples_frag();
std::span<const std::uint32_t> road_mirror_spread_frag();
std::span<const std::uint32_t> bloom_up_frag();
std::span<const std::uint32_t> smoothing_frag();
std::span<const std::uint32_t> temporal_frag();
std::span<const std::uint32_t> tone_mapping_frag();
std::span<const std::uint32_t> tone_mapping_samples_frag();
std::span<const std::uint32_t> ice_vert();
std::span<const std::uint32_t> ice_frag();
std::span<const std::uint32_t> ice_inside_vert();
std::span<const std::uint32_t> ice_layer_vert();
std::span<const std::uint32_t> ice_layer_frag();
std::span<const std::uint32_t> ice_crack_frag();
std::span<const std::uint32_t> ice_glass_frag();
std::span<const std::uint32_t> ice_inside_frag();
std::span<const std::uint32_t> overlay_vert();
std::span<const std::uint32_t> overlay_frag();

}  // namespace septet::render::shaders

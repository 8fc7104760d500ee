#include "engine/render/passes/shaders.hpp"

namespace septet::render::shaders {
namespace {

constexpr std::uint32_t surface_vert_code[] = {
#include "engine/render/shaders/surface.vert.inc"
};
constexpr std::uint32_t surface_frag_code[] = {
#include "engine/render/shaders/surface.frag.inc"
};
constexpr std::uint32_t shadow_vert_code[] = {
#include "engine/render/shaders/shadow.vert.inc"
};
constexpr std::uint32_t shadow_cut_frag_code[] = {
#include "engine/render/shaders/shadow_cut.frag.inc"
};
constexpr std::uint32_t shadow_fade_frag_code[] = {
#include "engine/render/shaders/shadow_fade.frag.inc"
};
constexpr std::uint32_t sky_vert_code[] = {
#include "engine/render/shaders/sky.vert.inc"
};
constexpr std::uint32_t sky_frag_code[] = {
#include "engine/render/shaders/sky.frag.inc"
};
constexpr std::uint32_t glow_vert_code[] = {
#include "engine/render/shaders/glow.vert.inc"
};
constexpr std::uint32_t glow_frag_code[] = {
#include "engine/render/shaders/glow.frag.inc"
};
constexpr std::uint32_t smoke_vert_code[] = {
#include "engine/render/shaders/smoke.vert.inc"
};
constexpr std::uint32_t smoke_frag_code[] = {
#include "engine/render/shaders/smoke.frag.inc"
};
constexpr std::uint32_t precipitation_vert_code[] = {
#include "engine/render/shaders/precipitation.vert.inc"
};
constexpr std::uint32_t precipitation_frag_code[] = {
#include "engine/render/shaders/precipitation.frag.inc"
};
constexpr std::uint32_t contact_vert_code[] = {
#include "engine/render/shaders/contact.vert.inc"
};
constexpr std::uint32_t contact_frag_code[] = {
#include "engine/render/shaders/contact.frag.inc"
};
constexpr std::uint32_t mirror_glass_vert_code[] = {
#include "engine/render/shaders/mirror_glass.vert.inc"
};
constexpr std::uint32_t mirror_glass_frag_code[] = {
#include "engine/render/shaders/mirror_glass.frag.inc"
};
constexpr std::uint32_t wet_lamp_vert_code[] = {
#include "engine/render/shaders/wet_lamp.vert.inc"
};
constexpr std::uint32_t wet_lamp_frag_code[] = {
#include "engine/render/shaders/wet_lamp.frag.inc"
};
constexpr std::uint32_t whole_target_vert_code[] = {
#include "engine/render/shaders/whole_target.vert.inc"
};
constexpr std::uint32_t bloom_down_frag_code[] = {
#include "engine/render/shaders/bloom_down.frag.inc"
};
constexpr std::uint32_t bloom_down_samples_frag_code[] = {
#include "engine/render/shaders/bloom_down_samples.frag.inc"
};
constexpr std::uint32_t road_mirror_spread_frag_code[] = {
#include "engine/render/shaders/road_mirror_spread.frag.inc"
};
constexpr std::uint32_t bloom_up_frag_code[] = {
#include "engine/render/shaders/bloom_up.frag.inc"
};
constexpr std::uint32_t temporal_frag_code[] = {
#include "engine/render/shaders/temporal.frag.inc"
};
constexpr std::uint32_t smoothing_frag_code[] = {
#include "engine/render/shaders/smoothing.frag.inc"
};
constexpr std::uint32_t tone_mapping_frag_code[] = {
#include "engine/render/shaders/tone_mapping.frag.inc"
};
constexpr std::uint32_t tone_mapping_samples_frag_code[] = {
#include "engine/render/shaders/tone_mapping_samples.frag.inc"
};
constexpr std::uint32_t ice_vert_code[] = {
#include "engine/render/shaders/ice.vert.inc"
};
constexpr std::uint32_t ice_frag_code[] = {
#include "engine/render/shaders/ice.frag.inc"
};
constexpr std::uint32_t ice_inside_vert_code[] = {
#include "engine/render/shaders/ice_inside.vert.inc"
};
constexpr std::uint32_t ice_layer_vert_code[] = {
#include "engine/render/shaders/ice_layer.vert.inc"
};
constexpr std::uint32_t ice_layer_frag_code[] = {
#include "engine/render/shaders/ice_layer.frag.inc"
};
constexpr std::uint32_t ice_crack_frag_code[] = {
#include "engine/render/shaders/ice_crack.frag.inc"
};
constexpr std::uint32_t ice_glass_frag_code[] = {
#include "engine/render/shaders/ice_glass.frag.inc"
};
constexpr std::uint32_t ice_inside_frag_code[] = {
#include "engine/render/shaders/ice_inside.frag.inc"
};
constexpr std::uint32_t overlay_vert_code[] = {
#include "engine/render/shaders/overlay.vert.inc"
};
constexpr std::uint32_t overlay_frag_code[] = {
#include "engine/render/shaders/overlay.frag.inc"
};

}  // namespace

std::span<const std::uint32_t> surface_vert() { return surface_vert_code; }
std::span<const std::uint32_t> surface_frag() { return surface_frag_code; }
std::span<const std::uint32_t> shadow_vert() { return shadow_vert_code; }
std::span<const std::uint32_t> shadow_cut_frag() { return shadow_cut_frag_code; }
std::span<const std::uint32_t> shadow_fade_frag() { return shadow_fade_frag_code; }
std::span<const std::uint32_t> sky_vert() { return sky_vert_code; }
std::span<const std::uint32_t> sky_frag() { return sky_frag_code; }
std::span<const std::uint32_t> glow_vert() { return glow_vert_code; }
std::span<const std::uint32_t> glow_frag() { return glow_frag_code; }
std::span<const std::uint32_t> smoke_vert() { return smoke_vert_code; }
std::span<const std::uint32_t> smoke_frag() { return smoke_frag_code; }
std::span<const std::uint32_t> precipitation_vert() { return precipitation_vert_code; }
std::span<const std::uint32_t> precipitation_frag() { return precipitation_frag_code; }
std::span<const std::uint32_t> contact_vert() { return contact_vert_code; }
std::span<const std::uint32_t> contact_frag() { return contact_frag_code; }
std::span<const std::uint32_t> mirror_glass_vert() { return mirror_glass_vert_code; }
std::span<const std::uint32_t> mirror_glass_frag() { return mirror_glass_frag_code; }
std::span<const std::uint32_t> wet_lamp_vert() { return wet_lamp_vert_code; }
std::span<const std::uint32_t> wet_lamp_frag() { return wet_lamp_frag_code; }
std::span<const std::uint32_t> whole_target_vert() { return whole_target_vert_code; }
std::span<const std::uint32_t> bloom_down_frag() { return bloom_down_frag_code; }
std::span<const std::uint32_t> bloom_down_samples_frag() { return bloom_down_samples_frag_code; }
std::span<const std::uint32_t> road_mirror_spread_frag() { return road_mirror_spread_frag_code; }
std::span<const std::uint32_t> bloom_up_frag() { return bloom_up_frag_code; }
std::span<const std::uint32_t> smoothing_frag() { return smoothing_frag_code; }
std::span<const std::uint32_t> temporal_frag() { return temporal_frag_code; }
std::span<const std::uint32_t> tone_mapping_frag() { return tone_mapping_frag_code; }
std::span<const std::uint32_t> tone_mapping_samples_frag() { return tone_mapping_samples_frag_code; }
std::span<const std::uint32_t> ice_vert() { return ice_vert_code; }
std::span<const std::uint32_t> ice_frag() { return ice_frag_code; }
std::span<const std::uint32_t> ice_inside_vert() { return ice_inside_vert_code; }
std::span<const std::uint32_t> ice_layer_vert() { return ice_layer_vert_code; }
std::span<const std::uint32_t> ice_layer_frag() { return ice_layer_frag_code; }
std::span<const std::uint32_t> ice_crack_frag() { return ice_crack_frag_code; }
std::span<const std::uint32_t> ice_glass_frag() { return ice_glass_frag_code; }
std::span<const std::uint32_t> ice_inside_frag() { return ice_inside_frag_code; }
std::span<const std::uint32_t> overlay_vert() { return overlay_vert_code; }
std::span<const std::uint32_t> overlay_frag() { return overlay_frag_code; }

}  // namespace septet::render::shaders

#pragma once
/// Glow around lamps: squares that face the viewer, added to the picture.

#include <functional>
#include <span>
#include <vector>

#include "engine/instant/atmosphere.hpp"
#include "engine/instant/participants.hpp"
#include "engine/light/records.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

using light::GlowRecord, light::WetLampRecord;

struct GlowPass {
  VkPipeline pipeline = VK_NULL_HANDLE, wet = VK_NULL_HANDLE;
};

void create_glow_pass(GlowPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                      const TargetFormats& formats);
void destroy_glow_pass(GlowPass& pass, const vulkan::Device& device);

/// Glows of the lamps that face the eye; larger and brighter in the dark. The glow is light scattered in the eye, as
/// bright as it appears relative to the adaptation (`exposure`). Beyond 50 m, where a lens is hardly visible itself,
/// its illuminance at the eye falls with the square of the distance; nearer it stays as at 50 m.
///
/// `share`: fraction of each lamp's light that reaches the eye through smoke.
std::vector<GlowRecord> glow_records(std::span<const LampGlow> glows, const Vec3& eye_m, float exposure,
                                     const std::function<float(const Vec3& lamp_m)>& share);

/// Mirror images of lamps on a road of this wetness; empty on a dry road. Their light is the reflected light of lens
/// and glow, less that of the lens where the road's mirror image (road_mirror_pass.hpp) already shows it
/// (`lenses_mirrored`).
std::vector<WetLampRecord> wet_lamp_records(std::span<const LampGlow> glows, const Vec3& eye_m, float wetness,
                                            float exposure, float emission_share, bool lenses_mirrored);

void draw_wet_lamps(const GlowPass& pass, PassContext& context, const FrameData& records, std::uint32_t count);
void draw_glows(const GlowPass& pass, PassContext& context, const FrameData& records, std::uint32_t count);

}  // namespace septet::render

#pragma once
/// Draws the glow around lamps: squares that face the viewer, added to the picture.

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

/// Those of the lamps that face the eye; larger and brighter in the dark. Light scattered in the eye, as bright as it looks beside
/// what the eye has adapted to (`exposure`). From 50 m on, where a lens is hardly seen itself, it falls with the square of
/// the distance; nearer it stays as it is there.
/// `share`: of each lamp's light that reaches the eye, through smoke.
std::vector<GlowRecord> glow_records(std::span<const LampGlow> glows, const Vec3& eye_m, float exposure,
                                     const std::function<float(const Vec3& lamp_m)>& share);

/// Lamps that a road of this wetness mirrors: of the light with which lens and glow are seen what water sends on, less what the mirror image
/// of the road (road_mirror_pass.hpp) shows of the lens, if there is one; none on a dry one.
std::vector<WetLampRecord> wet_lamp_records(std::span<const LampGlow> glows, const Vec3& eye_m, float wetness,
                                            float exposure, float emission_share, bool lenses_mirrored);

void draw_wet_lamps(const GlowPass& pass, PassContext& context, const FrameData& records, std::uint32_t count);
void draw_glows(const GlowPass& pass, PassContext& context, const FrameData& records, std::uint32_t count);

}  // namespace septet::render

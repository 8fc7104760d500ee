#include "engine/render/passes/glow_pass.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "engine/render/passes/billboards.hpp"
#include "engine/render/passes/shaders.hpp"

namespace septet::render {

void create_glow_pass(GlowPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                      const TargetFormats& formats) {
  pass.pipeline = create_billboard_pipeline(device, layout, formats, shaders::glow_vert(), shaders::glow_frag(),
                                            vulkan::Blend::add);
  pass.wet = create_billboard_pipeline(device, layout, formats, shaders::wet_lamp_vert(), shaders::wet_lamp_frag(),
                                       vulkan::Blend::add);
}

void destroy_glow_pass(GlowPass& pass, const vulkan::Device& device) {
  for (const VkPipeline pipeline : {pass.pipeline, pass.wet})
    if (pipeline) vkDestroyPipeline(device.device, pipeline, nullptr);
  pass = {};
}

namespace {
constexpr float lens_radius_m = 0.09f;
}

std::vector<GlowRecord> glow_records(std::span<const LampGlow> glows, const Vec3& eye_m, float exposure,
                                     float pixel_rad, const std::function<float(const Vec3&)>& share) {
  // 0 at noon, 1 at night.
  const float dark = std::clamp((exposure - 0.5f) / 3.0f, 0.0f, 1.0f);
  std::vector<GlowRecord> records;
  for (const LampGlow& glow : glows) {
    const glm::vec3 relative(glow.position_m - eye_m);
    const float distance_m = glm::length(relative);
    if (distance_m < 0.3f || distance_m > 3000.0f) continue;
    const bool around = glm::dot(glow.facing, glow.facing) < 0.5f;
    const float cosine = around ? 1.0f : glm::dot(glow.facing, -relative / distance_m);
    float turned = std::clamp(cosine * 1.6f - 0.1f, 0.0f, 1.0f);
    // Off the beam's axis a headlamp has less to glare with.
    if (glow.beam) turned *= 0.4f + 0.6f * std::exp(-12.0f * (1.0f - cosine * cosine));
    if (turned <= 1e-3f) continue;
    const float arriving = share(glow.position_m);
    if (arriving <= 1e-3f) continue;
    const float brightest = std::max({glow.color.r, glow.color.g, glow.color.b, 1e-6f});
    // The core is whiter than the halo: an eye (and a camera) saturates there.
    const glm::vec3 hue = glm::mix(glow.color / brightest, glm::vec3(1.0f), 0.08f);
    // By day a lamp is hardly more than its lens; a beacon is made to be seen.
    const float radius_m = glow.radius_m * (around ? 1.0f + 0.9f * dark : 0.7f + 1.2f * dark);
    // A lens that is seen as many pixels is bright itself: what is left is a weak halo around it.
    const float lens_px = lens_radius_m / (distance_m * pixel_rad);
    const float strength = (around ? 3.2f + 0.4f * dark : 0.7f + 2.5f * dark) / (1.0f + 0.33f * lens_px);
    const glm::vec3 brightness = hue * (turned * strength);  // As it looks: about the root of light, 1 white.
    records.push_back(
        {glm::vec4(relative, radius_m), glm::vec4(brightness * brightness * (arriving / exposure), 0.0f)});
  }
  return records;
}

std::vector<WetLampRecord> wet_lamp_records(std::span<const LampGlow> glows, const Vec3& eye_m, float wetness,
                                            float emission_share) {
  std::vector<WetLampRecord> records;
  if (wetness <= 0.0f) return records;
  for (const LampGlow& glow : glows) {
    const glm::vec3 relative(glow.position_m - eye_m);
    const float distance_m = glm::length(glm::vec2(relative));
    const auto road = static_cast<float>(glow.road_z_m - eye_m.z);
    if (distance_m < 2.0f || distance_m > 400.0f || road > -0.3f || relative.z < road) continue;
    const bool around = glm::dot(glow.facing, glow.facing) < 0.5f;
    const float cosine = around ? 1.0f : glm::dot(glow.facing, -relative / glm::length(relative));
    if (cosine <= 0.0f) continue;
    records.push_back({glm::vec4(relative, lens_radius_m),
                       glm::vec4(glow.color * (wetness * emission_share * std::min(1.0f, 2.0f * cosine)), road)});
  }
  return records;
}

void draw_wet_lamps(const GlowPass& pass, PassContext& context, const FrameData& records, std::uint32_t count) {
  draw_billboards(pass.wet, context, records, count);
}

void draw_glows(const GlowPass& pass, PassContext& context, const FrameData& records, std::uint32_t count) {
  draw_billboards(pass.pipeline, context, records, count);
}

}  // namespace septet::render

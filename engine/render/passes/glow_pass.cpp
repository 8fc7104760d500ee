#include "engine/render/passes/glow_pass.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/light/beam.hpp"
#include "engine/light/wet_road.hpp"
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
/// Distance below which the lens itself is visible, and the glow around it gives the eye no more light than from there.
constexpr float lens_seen_m = 50.0f;
/// Integral of the profile in shaders/glow.frag over a glow of radius 1 and radiance 1 in its middle.
constexpr float glow_integral = 0.133f;

/// Ratio of the light in this direction (unit, from the lamp) with the main beam on to that of the dipped beam alone.
float main_beam_times(const LampGlow& glow, const glm::vec3& way) {
  if (!glow.beam || glow.main_beam <= 0.0f) return 1.0f;
  return std::max(1.0f, light::beam_share(glow.facing, way, glow.main_beam, 1.0f) /
                            std::max(light::dipped_share(glow.facing, way, 1.0f), 1e-6f));
}

/// Glow of a lamp, without obstacles between it and the eye; black if the lamp faces away.
struct Shine {
  glm::vec3 radiance{0.0f};
  float radius_m = 0.0f;
};

Shine shine(const LampGlow& glow, const glm::vec3& toward_eye, float exposure, float distance_m) {
  // 0 at noon, 1 at night.
  const float dark = std::clamp((exposure - 0.5f) / 3.0f, 0.0f, 1.0f);
  const bool around = glm::dot(glow.facing, glow.facing) < 0.5f;
  const float cosine = around ? 1.0f : glm::dot(glow.facing, toward_eye);
  float turned = std::clamp(cosine * 1.6f - 0.1f, 0.0f, 1.0f);
  // A headlamp glares less off the beam's axis.
  if (glow.beam) turned *= 0.4f + 0.6f * std::exp(-12.0f * (1.0f - cosine * cosine));
  const float brightest = std::max({glow.color.r, glow.color.g, glow.color.b, 1e-6f});
  // By night the core is whiter than the halo: eyes (and cameras) saturate there.
  const glm::vec3 hue = glm::mix(glow.color / brightest, glm::vec3(1.0f), 0.08f * dark);
  // By day a lamp is hardly more than its lens, a tail lamp the least of all; beacons are made to be seen.
  const float by_day = glow.beam ? 0.7f : std::min(1.3f, std::sqrt(brightest / 3.5f));
  const float strength = around ? 3.2f + 0.4f * dark : glm::mix(by_day, glow.beam ? 4.0f : 3.0f, dark);
  // Limit: 80 times the dipped beam's light, which gives nine times the radiance, 1.7 times as wide; more would hide
  // the car and the road beside it.
  const float brighter = std::pow(std::min(main_beam_times(glow, toward_eye), 80.0f), 0.25f),
              wider = std::sqrt(brighter);
  const glm::vec3 brightness = hue * (turned * strength * brighter * std::min(1.0f, distance_m / lens_seen_m));
  // Brightness as it appears: about the root of light, 1 is white.
  return {brightness * brightness / exposure,
          glow.radius_m * wider * (around ? 1.0f + 0.9f * dark : 0.7f + 1.2f * dark)};
}

}  // namespace

std::vector<GlowRecord> glow_records(std::span<const LampGlow> glows, const Vec3& eye_m, float exposure,
                                     const std::function<float(const Vec3&)>& share) {
  std::vector<GlowRecord> records;
  for (const LampGlow& glow : glows) {
    const glm::vec3 relative(glow.position_m - eye_m);
    const float distance_m = glm::length(relative);
    if (distance_m < 0.3f || distance_m > 3000.0f) continue;
    const Shine shines = shine(glow, -relative / distance_m, exposure, distance_m);
    if (!(shines.radiance.r + shines.radiance.g + shines.radiance.b > 1e-6f)) continue;
    const float arriving = share(glow.position_m);
    if (arriving <= 1e-3f) continue;
    records.push_back({glm::vec4(relative, shines.radius_m), glm::vec4(shines.radiance * arriving, 0.0f)});
  }
  return records;
}

std::vector<WetLampRecord> wet_lamp_records(std::span<const LampGlow> glows, const Vec3& eye_m, float wetness,
                                            float exposure, float emission_share, bool lenses_mirrored) {
  constexpr float pi = 3.14159265f;
  std::vector<WetLampRecord> records;
  if (wetness <= 0.0f) return records;
  // The mirror image of objects over the road shows the lens already, as sharply as film and puddles do.
  const float sharp = !lenses_mirrored ? 0.0f : light::water_covers(wetness, light::puddle_share(wetness));
  for (const LampGlow& glow : glows) {
    const glm::vec3 relative(glow.position_m - eye_m);
    const float distance_m = glm::length(glm::vec2(relative));
    const auto road = static_cast<float>(glow.road_z_m - eye_m.z);
    if (distance_m < 2.0f || distance_m > 400.0f || road > -0.3f || relative.z < road) continue;
    const bool around = glm::dot(glow.facing, glow.facing) < 0.5f;
    const float cosine = around ? 1.0f : glm::dot(glow.facing, -relative / glm::length(relative));
    if (cosine <= 0.0f) continue;
    const glm::vec3 lens =
        glow.color * (emission_share * std::min(1.0f, 2.0f * cosine) * pi * lens_radius_m * lens_radius_m);
    const Shine shines = shine(glow, -relative / glm::length(relative), exposure, glm::length(relative));
    const glm::vec3 around_it = shines.radiance * (glow_integral * shines.radius_m * shines.radius_m);
    records.push_back(
        {glm::vec4(relative, lens_radius_m), glm::vec4(wetness * (lens + around_it) - sharp * lens, road)});
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

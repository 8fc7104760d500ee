#pragma once
/// Shade that smoke throws on surfaces in the light of sun or moon: a map across the light, made on the CPU once a frame
/// from merged puffs; shaders/smoke_shade.glsl reads it. The law is in engine/light/smoke_shade.hpp.
///
/// Texels lie on a raster that is fixed in the world, as large as the smoke needs. Where the light meets smoke under a
/// roof, no shade is due.

#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/instant/scene_summary.hpp"
#include "engine/light/smoke_shade.hpp"
#include "engine/render/passes/pass_context.hpp"
#include "engine/render/passes/shadow_cascades.hpp"
#include "engine/render/passes/view_uniforms.hpp"
#include "engine/render/words.hpp"

namespace septet::render {

struct SmokeShade {
  glm::vec3 right{0.0f}, up{0.0f}, to_light{0.0f};  ///< World axes of the light's view.
  Vec3 corner_m{0.0};                               ///< World: lower corner of the map; heights count from here.
  float texel_m = 1.0f;
  /// Moments of the texels, row by row along `right`; w unused. Empty where no shade would be seen.
  std::vector<glm::vec4> moments;
};

/// Shade of puffs within 300 m of the eye, on the axes of the light's cascades.
SmokeShade smoke_shade(std::span<const SmokePuff> puffs, const SceneSummary& scene, const ShadowCascades& shadows);

/// Optical depths of the shade's smoke from a place of the world towards the light and away from it.
struct DepthsInSmoke {
  float to_light = 0.0f, away = 0.0f;
};
DepthsInSmoke depths_in(const SmokeShade& shade, const Vec3& place_m);

/// Sets the rows from places relative to an eye to the map's texels.
void set_smoke_shade(ViewUniforms& uniforms, const SmokeShade& shade, const Vec3& eye_m);

/// Copies the moments into the frame's arena: no buffer for an empty shade.
FrameData store_smoke_shade(PassContext& context, const SmokeShade& shade);

/// Shade of a frame, and its moments in the arena: no buffer where no surface is shaded.
struct PreparedSmokeShade {
  SmokeShade shade;
  FrameData moments;
};

}  // namespace septet::render

#pragma once
/// Smoke: soft balls that face the viewer, lit by sky, lamps under roofs and headlights, drawn back to front over the surfaces behind them.
///
/// Many puffs overlap in every pixel, so they are merged first, into cells that grow with the distance from the eye,
/// and puffs behind dense smoke are left out. Cells are fixed in the world and all screens of a rig have one eye, so
/// that smoke meets at their edges. Optical depth adds up: alpha is 1 − exp(−depth) (Beer and Lambert).

#include <span>
#include <vector>

#include "engine/instant/atmosphere.hpp"
#include "engine/light/records.hpp"
#include "engine/render/passes/device_scene.hpp"
#include "engine/render/passes/pass_context.hpp"
#include "engine/render/passes/smoke_beams.hpp"
#include "engine/render/passes/smoke_shade.hpp"

namespace septet::render {

using light::PuffRecord;

struct SmokePass {
  VkPipeline pipeline = VK_NULL_HANDLE;
};

void create_smoke_pass(SmokePass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                       const TargetFormats& formats);
void destroy_smoke_pass(SmokePass& pass, const vulkan::Device& device);

/// Puffs merged for an eye, as above. World frame.
std::vector<SmokePuff> merged_puffs(std::span<const SmokePuff> puffs, const Vec3& eye_m);

/// Shares of the light of sun or moon and of that from around which other smoke leaves a puff.
struct LightWithin {
  float sun = 1.0f, around = 1.0f;
};

/// Merged puffs of an eye, and the light of beams on each.
struct DrawnSmoke {
  std::vector<SmokePuff> puffs;
  std::vector<glm::vec3> beams;
  std::vector<LightWithin> within;  ///< One a puff, or empty: nothing is lost.
};
DrawnSmoke drawn_smoke(std::span<const SmokePuff> puffs, std::span<const Headlight> headlights, const Vec3& eye_m);

/// Light within the smoke, by its shade.
void shade_smoke(DrawnSmoke& smoke, const SmokeShade& shade);

/// Share of the light that the puffs transmit from a point to the eye.
float transmittance(std::span<const SmokePuff> puffs, const Vec3& eye_m, const Vec3& point_m);

/// Records of the puffs that a view draws, farthest first.
std::vector<PuffRecord> puff_records(const DrawnSmoke& smoke, const DeviceScene& scene, const SkyLight& light,
                                     const FrameView& view, const Vec3& eye_m);

void draw_smoke(const SmokePass& pass, PassContext& context, const FrameData& records, std::uint32_t count);

}  // namespace septet::render

#pragma once
/// Rain and snow near the eye: each drop is drawn as its streak of a sixtieth of a second, relative to the eye.
///
/// Drops stand in a box of 12 m that repeats, so that the same drop is seen on all screens and from frame to frame.
/// Sizes are spread evenly over 1 to 3 mm (flakes: 4 to 9 mm); speeds of drops are Gunn and Kinzer's (Atlas's fit,
/// 1973). The opacity of a streak is the share D/(v·T) of the time that its drop covers a point, half a per cent at 25
/// m/s, drawn fortyfold (a flake tenfold), since one drop stands for some hundreds (Marshall and Palmer: 250 above 1 mm
/// in a cubic metre at 10 mm/h, 0.9 here). Precipitation farther away is part of the visibility. A drop gathers light
/// from all around (Garg and Nayar 2006): its radiance is about the mean of sky and ground, with a share of the sun's
/// light.

#include <vector>

#include <glm/vec4.hpp>

#include "engine/instant/instant.hpp"
#include "engine/light/records.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

using light::StreakRecord;

/// Streaks that a view may see; empty without precipitation. Below 274.65 K it is snow.
std::vector<StreakRecord> streak_records(const Instant& instant, const FrameView& view, const Vec3& eye_m);

struct PrecipitationPass {
  VkPipeline pipeline = VK_NULL_HANDLE;
};

void create_precipitation_pass(PrecipitationPass& pass, const vulkan::Device& device,
                               const vulkan::PipelineLayout& layout, const TargetFormats& formats);
void destroy_precipitation_pass(PrecipitationPass& pass, const vulkan::Device& device);
void draw_precipitation(const PrecipitationPass& pass, PassContext& context, const FrameData& records,
                        std::uint32_t count);

}  // namespace septet::render

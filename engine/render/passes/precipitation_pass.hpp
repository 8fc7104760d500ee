#pragma once
/// Rain and snow that falls near the eye: each drop is the streak that it draws in a sixtieth of a second, relative to the eye.
///
/// Drops stand in a box of 12 m that repeats; so the same drop is seen on all screens and from frame to frame. Sizes are spread evenly over 1 to 3 mm,
/// speeds are Gunn and Kinzer's (Atlas's fit, 1973). A streak hides what its drop hides of it: D/(v·T), half a per cent at 25 m/s, drawn
/// fortyfold (a flake tenfold), as one drop of some hundreds is drawn (Marshall and Palmer: 250 above 1 mm in a cubic metre at 10 mm/h, 0.9
/// here); what lies further off is in the visibility. A drop gathers light from all around (Garg and Nayar 2006):
/// it is as bright as sky and ground in the mean.

#include <vector>

#include <glm/vec4.hpp>

#include "engine/instant/instant.hpp"
#include "engine/light/records.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

using light::StreakRecord;

/// Those that a view may see; none where nothing falls. Below 274.65 K it falls as snow.
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

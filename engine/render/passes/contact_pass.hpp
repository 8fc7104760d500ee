#pragma once
/// Contact shadows: share of the sky that bodies hide from the ground under and around them. Under a closed cover, in a
/// tunnel and at night no shadow of the sun ties a vehicle to its road.
///
/// One rectangle a body, over the ground alone, in closed form (shaders/contact.frag); a ray tracer finds the same by
/// its rays.

#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "engine/instant/participants.hpp"
#include "engine/light/records.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

using light::ContactRecord;

struct ContactPass {
  VkPipeline pipeline = VK_NULL_HANDLE;
};

void create_contact_pass(ContactPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                         const TargetFormats& formats, const Refinements& refinements);
void destroy_contact_pass(ContactPass& pass, const vulkan::Device& device);

/// Greatest number of contacts in a view: the nearest of those that cover at least 0.3 of a pixel (`pixel_rad` wide).
inline constexpr std::size_t most_contacts = 48;
std::vector<ContactRecord> contact_records(std::span<const GroundContact> contacts, const Vec3& eye_m,
                                           const ViewVolume& volume, float pixel_rad);

void draw_contacts(const ContactPass& pass, PassContext& context, const FrameData& records, std::uint32_t count);

}  // namespace septet::render

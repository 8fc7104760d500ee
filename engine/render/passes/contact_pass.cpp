#include "engine/render/passes/contact_pass.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "engine/render/passes/billboards.hpp"
#include "engine/render/passes/shaders.hpp"

namespace septet::render {

void create_contact_pass(ContactPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                         const TargetFormats& formats, const Refinements& refinements) {
  TargetFormats unmarked = formats;  // No marks: the contact shadow lies on static surfaces, as other shadows do.
  unmarked.marks = false;
  pass.pipeline = create_billboard_pipeline(device, layout, unmarked, shaders::contact_vert(), shaders::contact_frag(),
                                            vulkan::Blend::over, refinements);
}

void destroy_contact_pass(ContactPass& pass, const vulkan::Device& device) {
  if (pass.pipeline) vkDestroyPipeline(device.device, pass.pipeline, nullptr);
  pass = {};
}

std::vector<ContactRecord> contact_records(std::span<const GroundContact> contacts, const Vec3& eye_m,
                                           const ViewVolume& volume, float pixel_rad) {
  std::vector<ContactRecord> records;
  for (const GroundContact& contact : contacts) {
    const glm::vec3 relative(contact.world_from_body.position_m - eye_m);
    const float reach_m = glm::length(glm::vec2(contact.half_length_m, contact.half_width_m)) + 2.3f * contact.height_m;
    const float distance_m = glm::length(relative);
    // The ground behind the body is hidden, and the height of the ground before it depends on the eye's angle of
    // depression.
    const float seen_px =
        contact.half_width_m * std::abs(relative.z) / std::max(1e-3f, distance_m * distance_m * pixel_rad);
    if (seen_px < 0.3f || !intersects(volume, relative, reach_m)) continue;
    const glm::vec3 ahead(contact.world_from_body.orientation * Vec3(1, 0, 0)),
        aside(contact.world_from_body.orientation * Vec3(0, 1, 0));
    records.push_back({glm::vec4(relative, contact.height_m), glm::vec4(ahead, contact.half_length_m),
                       glm::vec4(aside, contact.half_width_m),
                       glm::vec4(contact.clearance_m, contact.share_of_sky, 0.0f, 0.0f)});
  }
  const auto square = [](const ContactRecord& record) {
    return glm::dot(glm::vec3(record.middle), glm::vec3(record.middle));
  };
  std::stable_sort(records.begin(), records.end(),
                   [&](const ContactRecord& a, const ContactRecord& b) { return square(a) < square(b); });
  records.resize(std::min(records.size(), most_contacts));
  return records;
}

void draw_contacts(const ContactPass& pass, PassContext& context, const FrameData& records, std::uint32_t count) {
  draw_billboards(pass.pipeline, context, records, count);
}

}  // namespace septet::render

#include "engine/render/passes/shadow_cascades.hpp"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace septet::render {
namespace {

constexpr std::array<float, cascade_count> half_sides_m{22.0f, 130.0f};
constexpr float half_depth_m = 260.0f;

}  // namespace

ShadowCascades shadow_cascades(const Vec3& eye_m, const glm::vec3& to_light) {
  ShadowCascades shadows;
  shadows.eye_m = eye_m;
  const Vec3 z = glm::normalize(Vec3(to_light));
  const Vec3 x = std::abs(z.z) > 0.999 ? Vec3(1, 0, 0) : glm::normalize(glm::cross(Vec3(0, 0, 1), z));
  const Vec3 y = glm::cross(z, x);
  for (std::size_t i = 0; i < cascade_count; ++i) {
    Cascade& cascade = shadows.cascades[i];
    cascade.right = glm::vec3(x);
    cascade.up = glm::vec3(y);
    cascade.to_light = glm::vec3(z);
    cascade.half_side_m = half_sides_m[i];
    cascade.half_depth_m = half_depth_m;
    cascade.texel_m = 2.0f * half_sides_m[i] / cascade_texels;
    // The middle is a whole number of texels from the world's origin.
    const double texel_m = cascade.texel_m, u = glm::dot(eye_m, x), v = glm::dot(eye_m, y);
    const double whole_u = std::floor(u / texel_m), whole_v = std::floor(v / texel_m);
    cascade.middle_m = glm::vec2(whole_u * texel_m - u, whole_v * texel_m - v);
    const auto in_tile = [](double texel) {
      return static_cast<float>(texel - std::floor(texel / cascade_texels) * cascade_texels);
    };
    cascade.first_texel = {in_tile(whole_u - 0.5 * cascade_texels), in_tile(whole_v - 0.5 * cascade_texels)};
  }
  return shadows;
}

glm::mat4 clip_from_relative(const Cascade& cascade) {
  const glm::vec3 x = cascade.right / cascade.half_side_m, y = cascade.up / cascade.half_side_m;
  const glm::vec3 z = 0.5f * cascade.to_light / cascade.half_depth_m;
  const glm::vec2 shift = -cascade.middle_m / cascade.half_side_m;
  return {glm::vec4(x.x, y.x, z.x, 0), glm::vec4(x.y, y.y, z.y, 0), glm::vec4(x.z, y.z, z.z, 0),
          glm::vec4(shift, 0.5f, 1)};
}

glm::mat4 texture_from_relative(const Cascade& cascade, const glm::vec3& offset_m) {
  const glm::mat4 texture_from_clip(0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 1, 0, 0.5f, 0.5f, 0, 1);
  return texture_from_clip * clip_from_relative(cascade) * glm::translate(glm::mat4(1.0f), offset_m);
}

glm::vec4 far_from_near(const ShadowCascades& shadows) {
  const Cascade &near = shadows.cascades[0], &far = shadows.cascades[1];
  // t = ½ + (p − middle)/(2·half), so far = ½ + ((near − ½)·2·half_near + middle_near − middle_far)/(2·half_far).
  const float scale = near.half_side_m / far.half_side_m;
  const glm::vec2 shift = 0.5f - 0.5f * scale + 0.5f * (near.middle_m - far.middle_m) / far.half_side_m;
  return {scale, scale, shift.x, shift.y};
}

bool holds(const Cascade& cascade, const glm::vec3& centre_m, float radius_m) {
  const float reach = 0.94f * cascade.half_side_m - radius_m;  // Shaders leave the cascade at 0.96.
  return std::abs(glm::dot(centre_m, cascade.right) - cascade.middle_m.x) < reach &&
         std::abs(glm::dot(centre_m, cascade.up) - cascade.middle_m.y) < reach;
}

bool covers(const Cascade& cascade, const glm::vec3& centre_m, float radius_m) {
  const float reach = cascade.half_side_m + radius_m;
  return std::abs(glm::dot(centre_m, cascade.right) - cascade.middle_m.x) < reach &&
         std::abs(glm::dot(centre_m, cascade.up) - cascade.middle_m.y) < reach;
}

}  // namespace septet::render

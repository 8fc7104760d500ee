#include "engine/render/passes/shadow_cascades.hpp"

#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/relative.hpp"

using namespace septet;
using namespace septet::render;

namespace {

const Vec3 eye_m(98'765.4321, -12'345.678, 31.4);
const glm::vec3 to_light = glm::normalize(glm::vec3(0.5f, -0.3f, 0.8f));

glm::vec3 times(const glm::mat4& matrix, const glm::vec3& point) {
  const glm::vec4 result = matrix * glm::vec4(point, 1.0f);
  return glm::vec3(result) / result.w;
}

}  // namespace

TEST_CASE("a point's place in the far cascade follows from that in the near one") {
  const ShadowCascades shadows = shadow_cascades(eye_m, to_light);
  const glm::vec4 far = far_from_near(shadows);
  for (const glm::vec3 point : {glm::vec3(0.0f), glm::vec3(9.0f, 4.0f, -1.5f), glm::vec3(-15.0f, 7.0f, 3.0f)}) {
    const glm::vec3 in_near = times(texture_from_relative(shadows.cascades[0], glm::vec3(0.0f)), point);
    const glm::vec3 in_far = times(texture_from_relative(shadows.cascades[1], glm::vec3(0.0f)), point);
    CHECK(in_far.x == relative(far.x * in_near.x + far.z, 1e-5));
    CHECK(in_far.y == relative(far.y * in_near.y + far.w, 1e-5));
    CHECK(in_far.z == relative(in_near.z, 1e-6));
  }
}

TEST_CASE("a cascade's edges are those of its texture and depth grows towards the light") {
  const ShadowCascades shadows = shadow_cascades(eye_m, to_light);
  for (const Cascade& cascade : shadows.cascades) {
    const glm::mat4 texture = texture_from_relative(cascade, glm::vec3(0.0f));
    const glm::vec3 middle = cascade.middle_m.x * cascade.right + cascade.middle_m.y * cascade.up;
    for (const float side : {-1.0f, 1.0f}) {
      const glm::vec3 edge = times(texture, middle + side * cascade.half_side_m * cascade.right);
      CHECK(edge.x == doctest::Approx(0.5f + 0.5f * side).epsilon(1e-5).scale(1.0));
      CHECK(edge.y == relative(0.5f, 1e-5));
      CHECK(times(texture, middle + side * cascade.half_side_m * cascade.up).y ==
            doctest::Approx(0.5f + 0.5f * side).epsilon(1e-5).scale(1.0));
      CHECK(times(texture, middle + side * cascade.half_depth_m * cascade.to_light).z ==
            doctest::Approx(0.5f + 0.5f * side).epsilon(1e-5).scale(1.0));
    }
    CHECK(glm::length(cascade.to_light - to_light) < 1e-6f);
    CHECK(std::abs(cascade.right.z) < 1e-6f);  // Level.
    CHECK(cascade.up.z > 0.0f);
    CHECK(glm::length(glm::cross(cascade.right, cascade.up) - cascade.to_light) < 1e-6f);
    CHECK(cascade.texel_m * cascade_texels == doctest::Approx(2.0f * cascade.half_side_m));
  }
}

TEST_CASE("points seen from another eye fall on the same texels") {
  const ShadowCascades shadows = shadow_cascades(eye_m, to_light);
  const glm::vec3 offset(0.4f, -0.2f, 0.1f), from_eye(3.0f, 5.0f, -1.0f);
  for (const Cascade& cascade : shadows.cascades) {
    const glm::vec3 one = times(texture_from_relative(cascade, glm::vec3(0.0f)), from_eye);
    const glm::vec3 other = times(texture_from_relative(cascade, offset), from_eye - offset);
    CHECK(glm::length(one - other) < 1e-5f);
  }
}

TEST_CASE("cascades move in whole texels over the world") {
  const auto texel_of = [](const Vec3& eye, const Vec3& world, std::size_t i) {
    const ShadowCascades shadows = shadow_cascades(eye, to_light);
    const glm::vec3 at = times(texture_from_relative(shadows.cascades[i], glm::vec3(0.0f)), glm::vec3(world - eye));
    return glm::vec2(at) * static_cast<float>(cascade_texels);
  };
  for (const std::size_t i : {0u, 1u}) {
    const Vec3 world = eye_m + Vec3(4.0, 3.0, -1.5);
    const glm::vec2 before = texel_of(eye_m, world, i), after = texel_of(eye_m + Vec3(1.2345, -0.777, 0.05), world, i);
    const glm::vec2 moved = before - after;
    CHECK(glm::length(moved) > 1.0f);
    CHECK(std::abs(moved.x - std::round(moved.x)) < 0.02f);
    CHECK(std::abs(moved.y - std::round(moved.y)) < 0.02f);
    // The eye is never more than a texel from the middle.
    const Cascade cascade = shadow_cascades(eye_m, to_light).cascades[i];
    CHECK(cascade.middle_m.x <= 0.0f);
    CHECK(cascade.middle_m.x > -cascade.texel_m * 1.001f);
    CHECK(cascade.middle_m.y <= 0.0f);
    CHECK(cascade.middle_m.y > -cascade.texel_m * 1.001f);
  }
}

TEST_CASE("a light straight above has axes too") {
  const Cascade cascade = shadow_cascades(eye_m, {0.0f, 0.0f, 1.0f}).cascades[0];
  CHECK(glm::length(cascade.right) == doctest::Approx(1.0f));
  CHECK(glm::length(cascade.up) == doctest::Approx(1.0f));
}

TEST_CASE("a sphere is held where it lies wholly in the sampled part and covered where it reaches into the square") {
  const Cascade cascade = shadow_cascades(eye_m, to_light).cascades[1];
  const glm::vec3 middle = cascade.middle_m.x * cascade.right + cascade.middle_m.y * cascade.up;
  for (const glm::vec3& way : {cascade.right, -cascade.right, cascade.up, -cascade.up}) {
    const auto at = [&](float distance_m) { return middle + distance_m * way; };
    const float half = cascade.half_side_m, radius = 3.0f;
    CHECK(holds(cascade, at(0.93f * half - radius), radius));
    CHECK_FALSE(holds(cascade, at(0.95f * half - radius), radius));
    CHECK(covers(cascade, at(half + radius - 0.1f), radius));
    CHECK_FALSE(covers(cascade, at(half + radius + 0.1f), radius));
  }
}

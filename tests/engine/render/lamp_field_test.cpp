#include "engine/render/passes/lamp_field.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/light/lamplight.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/relative.hpp"

namespace septet::render {
namespace {

constexpr float candela = 0.1f, height_m = 6.0f;

StandingLamp lamp(const Vec3& position_m, bool roofed = false) {
  return {position_m, height_m, glm::vec3(candela), roofed};
}

/// Texel whose middle is at a place, or near it.
glm::vec4 texel(const LampField& field, const Vec2& place_m) {
  const Vec2 at = (place_m - field.corner_m) / LampField::texel_m;
  return field.texels[static_cast<std::size_t>(at.y) * LampField::side + static_cast<std::size_t>(at.x)];
}

const glm::vec3 up(0, 0, 1);

/// Quad of 0.4 × 0.2 m that faces down, 6 m above its instance's origin.
scene::ResolvedScene hanging_lens(float up_or_down) {
  scene::SurfaceMaterial material;
  material.emission = glm::vec3(0.5f);
  scene::SurfaceMesh lens;
  for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(0.4f, 0), glm::vec2(0.4f, 0.2f), glm::vec2(0, 0.2f)})
    lens.vertices.push_back({{corner.x, -up_or_down * corner.y, 6.0f}, {0, 0, -up_or_down}, {}});
  lens.indices = {0, 1, 2, 0, 2, 3};
  return instant::lone_mesh(material, lens, {Vec3(100, 50, 20), {1, 0, 0, 0}});
}

/// Light on a surface of that normal at a texel's place.
float lamplight(const glm::vec4& there, const glm::vec3& normal) {
  return light::lamplight(glm::vec3(there), light::from_all_sides(there), normal);
}

}  // namespace

TEST_CASE(
    "below a lamp the ground has its intensity over the height's square, and beside it as much under the sky, and less "
    "by "
    "the cosine's fourth power under a roof") {
  const Vec2 corner_m = lamp_field_corner({0, 0, 0});
  // In the middle of a texel.
  const Vec2 foot = corner_m + (Vec2(128, 128) + 0.5) * LampField::texel_m;
  const LampField field = lamp_field(std::array{lamp(Vec3(foot, 6.0))}, corner_m);
  const float below = lamplight(texel(field, foot), up);
  CHECK(below == relative(candela / (height_m * height_m), 1e-4));
  const float beside = lamplight(texel(field, foot + Vec2(6, 0)), up);
  CHECK(beside / below == relative(1.0f, 0.01));
  CHECK(lamplight(texel(field, foot + Vec2(8, 0)), up) / below == relative(1.0f, 0.02));
  CHECK(lamplight(texel(field, foot + Vec2(15, 0)), up) / below < 0.3f);
  // At 45°: cos⁴ is a quarter; the window that ends the lamp's reach takes a twentieth.
  const LampField roofed = lamp_field(std::array{lamp(Vec3(foot, 6.0), true)}, corner_m);
  CHECK(lamplight(texel(roofed, foot + Vec2(6, 0)), up) / lamplight(texel(roofed, foot), up) == relative(0.25f, 0.06));
  // A wall that faces the lamp is lit, its back is not.
  const glm::vec4 there = texel(field, foot + Vec2(6, 0));
  CHECK(lamplight(there, {-1, 0, 0}) > 0.5f * beside);
  CHECK(lamplight(there, {1, 0, 0}) < 1e-3f * beside);
  CHECK(texel(field, foot + Vec2(60, 0)) == glm::vec4(0.0f));
}

TEST_CASE("lamps under a roof and in the open are told apart and the field depends on where the eye is alone") {
  const Vec2 corner_m = lamp_field_corner({10, 10, 0});
  CHECK(corner_m == lamp_field_corner({-10, 20, 5}));
  const LampField field = lamp_field(std::array{lamp({0, 0, 6}), lamp({90, 0, 6}, true)}, corner_m);
  CHECK(field.open);
  CHECK(field.roofed);
  CHECK(texel(field, {0, 0}).w > 0.0f);
  CHECK(texel(field, {90, 0}).w < 0.0f);
  CHECK(lamp_field(std::array{lamp({1000, 0, 6})}, corner_m).texels.empty());
}

TEST_CASE("a tunnel's lamp lights its tube up to the walls on both sides and nothing of the tube beside it") {
  // Two upright walls along x, 4 m to the left of the lamp and 6 m to its right, and one further off.
  scene::ResolvedScene scene = hanging_lens(1.0f);
  scene.materials[0].share_of_sky = 0.0f;
  scene::SurfaceMaterial concrete;
  concrete.share_of_sky = 0.0f;
  scene.materials.push_back(concrete);
  scene::SurfaceMesh wall;
  for (const float y : {3.9f, -6.1f, -6.8f})
    for (const glm::vec2 corner : {glm::vec2(-60, 0), glm::vec2(60, 0), glm::vec2(60, 4), glm::vec2(-60, 4)})
      wall.vertices.push_back({{corner.x, y, corner.y}, {0, y > 0.0f ? -1 : 1, 0}, {}});
  for (const std::uint32_t first : {0u, 4u, 8u})
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) wall.indices.push_back(first + corner);
  wall.parts = {{0, static_cast<std::uint32_t>(wall.indices.size()), 1}};
  scene.meshes.push_back(wall);
  scene::Instance instance = scene.instances[0];
  instance.mesh = 1;
  scene.instances.push_back(instance);
  const std::vector<StandingLamp> lamps = instant::standing_lamps(scene);
  REQUIRE(lamps.size() == 1);
  CHECK(lamps[0].roofed);
  const LampField field = lamp_field(lamps, lamp_field_corner(lamps[0].position_m));
  const Vec2 at(lamps[0].position_m);
  for (const double along_m : {0.0, 15.0}) {
    CHECK(texel(field, at + Vec2(along_m, 3.0)).w < 0.0f);
    CHECK(texel(field, at + Vec2(along_m, -5.0)).w < 0.0f);
    CHECK(texel(field, at + Vec2(along_m, 6.0)).w == 0.0f);
    CHECK(texel(field, at + Vec2(along_m, -8.0)).w == 0.0f);
  }
}

TEST_CASE("what shines and looks down is a standing lamp and what shines and looks up is none") {
  const std::vector<StandingLamp> lamps = instant::standing_lamps(hanging_lens(1.0f));
  REQUIRE(lamps.size() == 1);
  CHECK(glm::length(lamps[0].position_m - Vec3(100.2, 49.9, 26)) < 0.01);
  CHECK(lamps[0].height_m == doctest::Approx(6.0f));
  CHECK(lamps[0].intensity.g == doctest::Approx(0.5f * 0.08f));
  CHECK(instant::standing_lamps(hanging_lens(-1.0f)).empty());
  scene::ResolvedScene broken = hanging_lens(1.0f);
  broken.meshes[0].indices[1] = 99;
  CHECK(instant::standing_lamps(broken).empty());
}

}  // namespace septet::render

/// Second reader of an instant's description, which knows no Vulkan: rays against its triangles, one by one.

#include <algorithm>
#include <cmath>
#include <optional>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/instant/instant.hpp"
#include "engine/light/tone_curve.hpp"
#include "tests/engine/instant/ray_through.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/relative.hpp"

namespace septet::instant {
namespace {

struct Hit {
  double distance_m = 1e12;
  std::uint32_t material = no_material;
  float emission_shines = 0.0f;
};

/// Möller and Trumbore (1997), both sides.
std::optional<double> crossing(const Vec3& from_m, const Vec3& ray, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, p = glm::cross(ray, ac);
  const double determinant = glm::dot(ab, p);
  if (std::abs(determinant) < 1e-12) return std::nullopt;
  const Vec3 t = (from_m - a) / determinant, q = glm::cross(t, ab);
  const double u = glm::dot(t, p), v = glm::dot(ray, q), at = glm::dot(ac, q);
  if (u < 0.0 || v < 0.0 || u + v > 1.0 || at <= 0.0) return std::nullopt;
  return at;
}

void meet(Hit& hit, const scene::ResolvedScene& scene, const PlacedMesh& placed, const Vec3& eye_m, const Vec3& ray) {
  const double away_m = glm::length(placed.origin_m - eye_m);
  if (!placed.seen || away_m < placed.visible_from_m || away_m >= placed.visible_to_m) return;
  const Vec3 to_centre = placed.origin_m + Vec3(placed.centre_m) - eye_m;
  const double along = glm::dot(to_centre, ray);
  if (glm::dot(to_centre, to_centre) - along * along > double(placed.radius_m) * placed.radius_m) return;
  const scene::SurfaceMesh& mesh = scene.meshes[placed.mesh];
  const auto corner = [&](std::uint32_t index) {
    return placed.origin_m + Vec3(placed.world_from_object * mesh.vertices[mesh.indices[index]].position_m);
  };
  for (const scene::MeshPart& part : mesh.parts)
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3)
      if (const auto at = crossing(eye_m, ray, corner(i), corner(i + 1), corner(i + 2)); at && *at < hit.distance_m)
        hit = {*at, part.material, placed.tint.w};
}

Hit first_hit(const Instant& instant, const scene::ResolvedScene& scene, const SceneSummary& summary, const Vec3& eye_m,
              const Vec3& ray) {
  Hit hit;
  for (const scene::Instance& still : scene.instances)
    meet(hit, scene, place(still, summary.meshes[still.mesh].bounds, still.world_from_object), eye_m, ray);
  for (const PlacedMesh& part : instant.parts) meet(hit, scene, part, eye_m, ray);
  for (const LooseMesh& loose : instant.loose)
    for (std::size_t i = 0; i + 2 < loose.mesh.vertices.size(); i += 3) {
      const auto corner = [&](std::size_t n) { return loose.mesh.origin_m + Vec3(loose.mesh.vertices[n].position_m); };
      if (const auto at = crossing(eye_m, ray, corner(i), corner(i + 1), corner(i + 2)); at && *at < hit.distance_m)
        hit = {*at, loose.material, 1.0f};
    }
  return hit;
}

struct Stage {
  ReferenceScene reference = reference_scene({{}, false, 0});
  SceneSummary summary = summarise(reference.scene);
  FrameInput input;

  Stage() {
    input.environment = reference_day();
    input.views = {forward_view({0, 0, 0}, 320, 200)};
  }
};

}  // namespace

TEST_CASE("rays find the car and its lit brake lamp and loose triangles before it and the sky above it") {
  Stage stage;
  stage.input.participants = {reference_car(stage.reference, {12.0, 0.0, 0.0})};
  stage.input.participants[0].lamps.set(Lamp::brake, true);
  const auto along = [&](const Vec3& target_m) {
    const Instant instant = describe(stage.input, stage.summary);
    const Vec3 eye_m = world_eye(instant.views[0]);
    return first_hit(instant, stage.reference.scene, stage.summary, eye_m, glm::normalize(target_m - eye_m));
  };
  // The lamp's face towards the eye lies at x = 12 − 1.01 − 0.03.
  const Hit lamp = along({10.96, 0.65, 0.68});
  REQUIRE(lamp.material != no_material);
  CHECK(stage.reference.scene.materials[lamp.material].emission.r > 1.0f);
  CHECK(lamp.emission_shines == 1.0f);
  const Hit body = along({11.0, 0.0, 0.55});
  REQUIRE(body.material != no_material);
  CHECK(stage.reference.scene.materials[body.material].takes_paint);
  CHECK(body.distance_m == relative(glm::length(Vec3(11.0, 0.0, 0.55) - world_eye(stage.input.views[0])), 1e-6));
  CHECK(along({100.0, 0.0, 200.0}).material == no_material);
  stage.input.participants[0].lamps.set(Lamp::brake, false);
  CHECK(along({10.96, 0.65, 0.68}).emission_shines == 0.0f);

  DynamicMesh shard;
  shard.prototype = stage.reference.car_prototype;
  shard.origin_m = {8.0, 0.0, 0.8};
  shard.radius_m = 1.0f;
  for (const glm::vec3& corner : {glm::vec3(0, -0.5f, -0.5f), glm::vec3(0, 0.5f, -0.5f), glm::vec3(0, 0, 0.5f)})
    shard.vertices.push_back({corner, {-1, 0, 0}, {}});
  stage.input.meshes = {shard};
  const Vec3 eye_m = world_eye(stage.input.views[0]);
  const Vec3 behind = eye_m + (Vec3(8.0, 0.0, 0.7) - eye_m) * 2.0;
  CHECK(along(behind).distance_m == relative(glm::length(Vec3(8.0, 0.0, 0.7) - eye_m), 1e-6));
}

TEST_CASE("a ray through a pixel goes where the projection takes it from in a mirror too") {
  for (const bool mirrored : {false, true}) {
    FrameView view = forward_view({40.0, -3.0, 0.0}, 320, 200);
    view.mirrored = mirrored;
    const Vec3 point_m = world_eye(view) + 17.0 * ray_through(view, 250.5, 31.5);
    const glm::dvec4 clip = view.projection.clip_from_eye_relative *
                            glm::dvec4(inverse(view.world_from_car) * point_m - view.projection.eye_m, 1.0);
    CHECK((0.5 + (mirrored ? -0.5 : 0.5) * clip.x / clip.w) * 320.0 == relative(250.5, 1e-9));
    CHECK((0.5 + 0.5 * clip.y / clip.w) * 200.0 == relative(31.5, 1e-9));
  }
}

TEST_CASE("an exposure value whitens what the standard says and noon and night lie where photographers put them") {
  CHECK(Exposure{15.0f}.scale() * 39322.0f / luminance_unit_cdpm2 == relative(1.0, 1e-4));
  CHECK(exposure_of_scale(Exposure{7.25f}.scale()).ev100 == doctest::Approx(7.25));
  Stage stage;
  const float noon = describe(stage.input, stage.summary).exposure.ev100;
  CHECK(noon > 13.0f);
  CHECK(noon < 16.0f);
  stage.input.environment.sun_elevation_rad = -0.4;
  CHECK(describe(stage.input, stage.summary).exposure.ev100 < noon - 4.0f);
}

TEST_CASE("a description depends on its input alone and headlights are in it only where it is dark") {
  Stage stage;
  stage.input.participants = {reference_car(stage.reference, {12.0, 0.0, 0.0})};
  stage.input.participants[0].lamps.set(Lamp::low_beam, true);
  const Instant day = describe(stage.input, stage.summary);
  CHECK(day.headlights.empty());
  CHECK(day.emission_share == 1.0f);
  const Instant again = describe(stage.input, stage.summary, day.light);
  CHECK(again.light == day.light);
  CHECK(again.exposure.ev100 == day.exposure.ev100);
  CHECK(again.parts.size() == day.parts.size());
  stage.input.environment.sun_elevation_rad = -0.4;
  const Instant night = describe(stage.input, stage.summary);
  CHECK(night.headlights.size() == 2);
  CHECK(night.emission_share < 0.5f);
}

TEST_CASE("light far brighter than white still differs on the display and darkness is black") {
  CHECK(light::display_code(glm::vec3(0.0f)).g == 0.0f);
  CHECK(light::display_code(glm::vec3(0.18f)).g == relative(0.5, 0.05));
  CHECK(light::display_code(glm::vec3(8.0f)).g > light::display_code(glm::vec3(4.0f)).g);
  CHECK(light::display_code(glm::vec3(1e6f)).g <= 1.0f);
}

}  // namespace septet::instant

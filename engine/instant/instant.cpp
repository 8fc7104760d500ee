#include "engine/instant/instant.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/check.hpp"

namespace septet::instant {
namespace {

/// The eye adapts to a lit, roofed place ahead of and around the car, in the same way on every screen: by day up, by night down.
float adapted_scale(const SceneSummary& scene, const SkyLight& light, const RigidTransform& world_from_car) {
  constexpr float roofed_scale = 2.6f;
  constexpr int samples = 9;
  float roofed = 0.0f;
  for (int i = 0; i < samples; ++i)
    roofed += (1.0f - share_of_sky(scene, world_from_car * Vec3(-10.0 + 6.0 * i, 0.0, 1.2))) / samples;
  return light.exposure * std::pow(roofed_scale / light.exposure, roofed);
}

/// The material of a prototype's first part that has one.
std::uint32_t material_of(const SceneSummary& scene, std::uint32_t prototype) {
  if (prototype >= scene.prototypes.size()) return no_material;
  for (const scene::Instance& part : scene.prototypes[prototype].parts)
    if (part.mesh < scene.meshes.size() && scene.meshes[part.mesh].first_material != no_material)
      return scene.meshes[part.mesh].first_material;
  return no_material;
}

}  // namespace

Instant describe(FrameInput input, const SceneSummary& scene, std::shared_ptr<const SkyLight> light) {
  SEPTET_CHECK(!input.views.empty(), "an instant without a view");
  Instant instant;
  instant.simulated_time_s = input.simulated_time_s;
  instant.environment = input.environment;
  instant.light = light ? std::move(light) : std::make_shared<const SkyLight>(sky_light(input.environment));
  const float scale = adapted_scale(scene, *instant.light, input.views.front().world_from_car);
  instant.exposure = exposure_of_scale(scale);
  instant.emission_share = 1.0f / std::max(1.0f, 0.35f * scale);

  PlacedParticipants placed = place_participants(input.participants, scene.prototypes, scene.meshes,
                                                 input.simulated_time_s, world_eye(input.views.front()),
                                                 [&](const Vec3& place_m) { return share_of_sky(scene, place_m); });
  instant.parts = std::move(placed.meshes);
  instant.lamps = std::move(placed.glows);
  if (scale > 1.0f) instant.headlights = std::move(placed.headlights);
  for (DynamicMesh& mesh : input.meshes) {
    const std::uint32_t material = material_of(scene, mesh.prototype);
    if (material == no_material || mesh.vertices.empty()) continue;
    const float share = share_of_sky(scene, mesh.origin_m);
    instant.loose.push_back({std::move(mesh), material, share});
  }
  for (ice::IceBody& body : input.ice) {
    if (body.vertices.size() < 3) continue;
    body.look.share_of_sky *= share_of_sky(scene, body.origin_m);
    instant.ice.push_back(std::move(body));
  }
  instant.ice_surroundings_px = input.ice_surroundings_px;
  instant.views = std::move(input.views);
  instant.smoke = std::move(input.smoke);
  instant.soot = std::move(input.soot);
  instant.overlay = std::move(input.overlay);
  return instant;
}

}  // namespace septet::instant

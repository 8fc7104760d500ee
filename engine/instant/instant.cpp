#include "engine/instant/instant.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/core/check.hpp"
#include "engine/instant/spray.hpp"

namespace septet::instant {
namespace {

/// Scale of the exposure: the eye adapts to a lit, roofed place ahead of and around the car, in the same way on every
/// screen: by day up, by night down.
float adapted_scale(const SceneSummary& scene, const SkyLight& light, const RigidTransform& world_from_car) {
  constexpr float roofed_scale = 2.6f;
  const float roofed =
      1.0f - share_of_sky(scene, world_from_car * Vec3(-13.0, 0.0, 1.2), world_from_car * Vec3(41.0, 0.0, 1.2));
  return light.exposure * std::pow(roofed_scale / light.exposure, roofed);
}

/// Headlights relative to the light of their place. Nights and tunnels are shown as if all light in them except the
/// lamps' were so many times brighter, so that a display need not show starlight: headlights are scaled likewise.
/// Headlights that add less than a fiftieth to the light of the road ten metres ahead are left out.
std::vector<Headlight> seen_headlights(std::vector<Headlight> all, const SceneSummary& scene, const SkyLight& light) {
  constexpr float under_roof = 15.0f, tunnel_lamps = 0.45f;
  constexpr float on_road_at_ten_metres = 0.37f * 0.35f / 100.0f;
  const auto luminance = [](const glm::vec3& c) { return glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f)); };
  const float open =
      luminance(light.sky_irradiance) + luminance(light.light_irradiance) * std::max(light.light_direction.z, 0.0f);
  std::erase_if(all, [&](Headlight& headlight) {
    const float sky = share_of_sky(scene, headlight.position_m);
    headlight.intensity *= glm::mix(under_roof, light.light_up, sky);
    return headlight.intensity * on_road_at_ten_metres < 0.02f * glm::mix(tunnel_lamps, open, sky);
  });
  return all;
}

/// Beacons whose light on other surfaces is visible.
std::vector<BeaconLight> seen_beacons(std::vector<BeaconLight> all, const SceneSummary& scene, const SkyLight& light) {
  constexpr float near_by_m2 = 9.0f, tunnel_lamps = 0.45f;
  std::erase_if(all, [&](const BeaconLight& beacon) {
    const float brightest = std::max({beacon.intensity.r, beacon.intensity.g, beacon.intensity.b});
    const float open = std::max({light.sky_irradiance.r, light.sky_irradiance.g, light.sky_irradiance.b});
    return brightest / near_by_m2 < 0.02f * glm::mix(tunnel_lamps, open, share_of_sky(scene, beacon.position_m));
  });
  return all;
}

/// Contacts of participants with the ground. Flat or floating bodies hide no sky.
std::vector<GroundContact> contacts_of(const std::vector<DrawnParticipant>& participants, const SceneSummary& scene) {
  std::vector<GroundContact> contacts;
  for (const DrawnParticipant& participant : participants) {
    if (participant.prototype >= scene.bodies.size()) continue;
    const BodyBounds& body = scene.bodies[participant.prototype];
    const glm::vec3 low = participant.stretch * body.min_m, high = participant.stretch * body.max_m;
    const glm::vec3 half = 0.5f * (high - low), middle = 0.5f * (high + low);
    if (!(half.x > 0.05f && half.y > 0.05f && high.z > 0.3f && low.z < 1.5f)) continue;
    GroundContact contact;
    contact.world_from_body = participant.world_from_vehicle;
    contact.world_from_body.position_m = participant.world_from_vehicle * Vec3(middle.x, middle.y, 0.0);
    contact.half_length_m = half.x;
    contact.half_width_m = half.y;
    contact.height_m = high.z;
    contact.clearance_m = std::clamp(low.z, 0.1f, 0.8f);
    contact.share_of_sky = share_of_sky(scene, participant.world_from_vehicle);
    contacts.push_back(contact);
  }
  return contacts;
}

/// Material of a prototype's first part that has one.
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
  instant.share_of_sky = share_of_sky(scene, world_eye(input.views.front()));
  instant.extinction_per_m = instant.light->fog_per_m + instant.share_of_sky * instant.light->fall_per_m;
  instant.road = road_below(input.participants, scene.prototypes, world_eye(input.views.front()));
  instant.emission_share = 1.0f / std::max(1.0f, 0.35f * scale);

  PlacedParticipants placed = place_participants(
      input.participants, scene.prototypes, scene.meshes, input.simulated_time_s, world_eye(input.views.front()),
      [&](const RigidTransform& world_from_vehicle) { return share_of_sky(scene, world_from_vehicle); });
  instant.parts = std::move(placed.meshes);
  for (const DrawnParticipant& participant : input.participants)
    if (participant.reshaped) instant.reshaped.push_back(participant.reshaped);
  instant.lamps = std::move(placed.glows);
  instant.headlights = seen_headlights(std::move(placed.headlights), scene, *instant.light);
  instant.beacons = seen_beacons(std::move(placed.beacons), scene, *instant.light);
  instant.contacts = contacts_of(input.participants, scene);
  for (DynamicMesh& mesh : input.meshes) {
    const std::uint32_t material = mesh.material ? *mesh.material : material_of(scene, mesh.prototype);
    if (material == no_material || mesh.vertices.empty()) continue;
    const float share = share_of_sky(scene, mesh.origin_m);
    instant.loose.push_back({std::move(mesh), material, share});
  }
  const auto take_ice = [&](std::vector<ice::IceBody>& from, std::vector<ice::IceBody>& into) {
    for (ice::IceBody& body : from) {
      if (body.vertices.size() < 3) continue;
      body.look.share_of_sky *= share_of_sky(scene, body.origin_m);
      into.push_back(std::move(body));
    }
  };
  take_ice(input.ice, instant.ice);
  take_ice(input.glass, instant.glass);
  instant.ice_surroundings_px = input.ice_surroundings_px;
  instant.ice_surroundings_kept = input.ice_surroundings_kept;
  instant.views = std::move(input.views);
  instant.mirrors = std::move(input.mirrors);
  instant.smoke = std::move(input.smoke);
  for (const DrawnParticipant& participant : input.participants) {
    constexpr double furthest_m = 250.0;
    const Vec3& at_m = participant.world_from_vehicle.position_m;
    // No rain falls under a roof, and the road there is dry.
    if (glm::length(at_m - world_eye(instant.views.front())) < furthest_m && share_of_sky(scene, at_m) > 0.5f)
      add_spray(participant, instant.environment, instant.simulated_time_s, instant.smoke);
  }
  instant.soot = std::move(input.soot);
  instant.overlay = std::move(input.overlay);
  return instant;
}

}  // namespace septet::instant

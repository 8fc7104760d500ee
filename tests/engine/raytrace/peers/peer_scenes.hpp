#pragma once
/// Scenes drawn by Septet and another path tracer, for comparison (peer_scene_main.cpp).
///
/// noon, night, tunnel: the motorway of matt surfaces with images and holes, lamps, sky, sun or moon. smoke: a puff in
/// the Cornell box. gloss: noon again with reflecting surfaces, cars' paint, metals and opaque glass, balls of them
/// near the eye, and the film of water on a wet road. ice: three bodies of it on the motorway below noon's sky without
/// the sun, whose light through them is left to the photons.
///
/// Sheets of glass, clear coats, puddles, retroreflection, headlights and fog, whose formulas are Septet's own, are
/// left out on both sides; tests beside check them against closed forms. A lamp lights as brightly as it appears.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/effects/ice/objects.hpp"
#include "engine/instant/scene_summary.hpp"
#include "engine/instant/standing_lamps.hpp"
#include "engine/light/wet_road.hpp"
#include "engine/raytrace/ray_tracer.hpp"
#include "tests/engine/raytrace/cornell_box.hpp"
#include "tests/images/motorway_view.hpp"

namespace septet::raytrace {

struct PeerScene {
  scene::ResolvedScene scene;
  instant::Instant instant;
  TraceSettings settings;
};

inline bool is_peer_scene(std::string_view name) {
  for (const std::string_view known : {"noon", "night", "tunnel", "smoke", "gloss", "ice"})
    if (name == known) return true;
  return false;
}

/// A reflecting layer of GGX facets over the diffuse base.
struct Gloss {
  float share = 0.0f;  ///< Share of its surface; 0: no gloss.
  float alpha = 1.0f;
  float f0 = 0.04f;  ///< Value of a dielectric.
  float metallic = 0.0f;
};

inline float wetness(const scene::SurfaceMaterial& material, const Environment& weather) {
  return material.wettable ? static_cast<float>(weather.road_wetness) * material.share_of_sky : 0.0f;
}

/// Same formulas as World's.
inline Gloss gloss_of(const scene::SurfaceMaterial& material, const Environment& weather) {
  if (const float wet = wetness(material, weather); wet > 0.0f)
    return {light::film_share * wet, light::film_roughness * light::film_roughness, light::water_reflectance, 0.0f};
  if (material.wettable || (material.roughness >= 0.6f && material.metallic <= 0.2f)) return {};
  const float index = (material.refraction_index - 1.0f) / (material.refraction_index + 1.0f);
  return {1.0f, std::max(1e-3f, material.roughness * material.roughness), index * index, material.metallic};
}

/// Reduces a scene to features that all path tracers have.
inline void simplify(scene::ResolvedScene& scene, bool matt) {
  for (scene::SurfaceMaterial& material : scene.materials) {
    material.retroreflection = 0.0f;
    material.clear_coat = 0.0f;
    if (matt) {
      material.roughness = 1.0f;
      material.metallic = 0.0f;
      material.wettable = false;
    }
    // Same as in World: a lamp under a roof lights others more brightly than it appears.
    material.emission *= glm::mix(instant::roofed_lamps_light_up, 1.0f, material.share_of_sky);
  }
  for (scene::SurfaceMesh& mesh : scene.meshes)
    for (scene::MeshPart& part : mesh.parts)
      if (scene.materials[part.material].opacity < 0.999f) part.index_count = 0;
  // Removes surfaces that are no longer referenced.
  for (scene::SurfaceMesh& mesh : scene.meshes) {
    std::vector<std::uint32_t> kept;
    for (scene::MeshPart& part : mesh.parts) {
      const auto from = mesh.indices.begin() + part.first_index;
      part.first_index = static_cast<std::uint32_t>(kept.size());
      kept.insert(kept.end(), from, from + part.index_count);
    }
    mesh.indices = std::move(kept);
  }
}

/// Adds three bodies side by side before the eye, ten times as blue as clear ice.
inline void add_ice(instant::Instant& instant) {
  const RigidTransform& car = instant.views.front().world_from_car;
  const Vec3 eye_m = instant::world_eye(instant.views.front());
  double to_left_m = 1.15;
  for (const ice::Surface& surface : {ice::sphere(), ice::peanut(), ice::cube()}) {
    ice::IceBody& body = instant.ice.emplace_back();
    body.origin_m = eye_m + car.orientation * Vec3(3.8, to_left_m, -0.25);
    body.vertices = surface;
    body.look.absorption_per_m *= 10.0f;
    to_left_m -= 1.15;
  }
}

/// Adds balls side by side before the eye: car paint, chrome, a rim's half metal and a dark window, as on vehicles.
inline void add_balls(scene::ResolvedScene& scene, instant::Instant& instant) {
  struct Look {
    glm::vec3 color;
    float roughness, metallic;
  };
  const RigidTransform& car = instant.views.front().world_from_car;
  const Vec3 eye_m = instant::world_eye(instant.views.front());
  const glm::vec3 bound(0.5f);
  double to_left_m = 1.2;
  for (const Look& look : {Look{{0.55f, 0.012f, 0.012f}, 0.28f, 0.0f}, Look{{0.75f, 0.75f, 0.76f}, 0.15f, 1.0f},
                           Look{{0.52f, 0.53f, 0.55f}, 0.35f, 0.8f}, Look{{0.012f, 0.016f, 0.018f}, 0.06f, 0.0f}}) {
    scene::SurfaceMesh& mesh = scene.meshes.emplace_back();
    for (const ice::IceVertex& vertex : ice::sphere()) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back({vertex.position_m, vertex.normal, {}});
    }
    mesh.bounds_min_m = -bound, mesh.bounds_max_m = bound;
    mesh.parts.push_back(
        {0, static_cast<std::uint32_t>(mesh.indices.size()), static_cast<std::uint32_t>(scene.materials.size())});
    scene::SurfaceMaterial& material = scene.materials.emplace_back();
    material.base_color = look.color;
    material.roughness = look.roughness;
    material.metallic = look.metallic;
    RigidTransform there = car;
    there.position_m = eye_m + car.orientation * Vec3(3.8, to_left_m, -0.35);
    instant.parts.push_back(
        instant::place(static_cast<std::uint32_t>(scene.meshes.size() - 1), {-bound, bound}, there, glm::vec3(0.72f)));
    to_left_m -= 0.8;
  }
}

inline PeerScene peer_motorway(std::string_view name) {
  const Motorway world;
  PeerScene peer{world.scene(), {}, {.filter = Filter::box}};
  simplify(peer.scene, name != "gloss");
  instant::FrameInput input = world.frame({"", name == "tunnel" ? 3350.0 : 800.0, 0.0, name == "night", false});
  input.environment.cloud_cover = 0.0;
  // The wettest road without puddles.
  if (name == "gloss") input.environment.road_wetness = 0.5;
  // A quarter of the pixels, for scenes whose pixels need four times the samples.
  if (name == "tunnel" || name == "gloss")
    input.views.front().viewport = {0, 0, motorway_width_px / 2, motorway_height_px / 2};
  input.participants.pop_back();  // The driver's own car is invisible.
  peer.instant = instant::describe(std::move(input), instant::summarise(peer.scene));
  peer.instant.headlights.clear();
  peer.instant.extinction_per_m = 0.0f;
  // Standing lamps would light more brightly than they appear; those of vehicles would not.
  for (const scene::Instance& instance : peer.scene.instances) {
    const scene::SurfaceMesh& mesh = peer.scene.meshes[instance.mesh];
    peer.instant.parts.push_back(
        instant::place(instance, {mesh.bounds_min_m, mesh.bounds_max_m}, instance.world_from_object));
  }
  peer.scene.instances.clear();
  for (instant::PlacedMesh& part : peer.instant.parts) part.share_of_sky = 1.0f;
  peer.settings.paths = {.longest = 8, .roulette_from = 100};
  if (name == "gloss") add_balls(peer.scene, peer.instant);
  if (name == "ice") {
    add_ice(peer.instant);
    instant::SkyLight sunless = *peer.instant.light;
    sunless.light_irradiance = glm::vec3(0.0f);
    peer.instant.light = std::make_shared<const instant::SkyLight>(std::move(sunless));
    peer.settings.paths.longest = 24;
  }
  return peer;
}

/// A puff in the middle of the Cornell box.
inline PeerScene peer_smoke_box() {
  PeerScene peer{cornell_box(), before_cornell_box(192), cornell_settings(0)};
  peer.instant.smoke.push_back({{0.0, 0.0, 0.1}, 0.15f, 0.5f, glm::vec3(0.9f, 0.8f, 0.7f), 0.0f, 0});
  peer.settings.paths.longest = 12;
  return peer;
}

inline PeerScene peer_scene(std::string_view name) { return name == "smoke" ? peer_smoke_box() : peer_motorway(name); }

}  // namespace septet::raytrace

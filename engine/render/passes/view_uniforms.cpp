#include "engine/render/passes/view_uniforms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/instant/clouds.hpp"
#include "engine/light/wet_road.hpp"

namespace septet::render {
namespace {

template <class Light>
std::vector<const Light*> nearest_of(std::span<const Light> lights, const Vec3& eye_m, std::size_t most) {
  std::vector<const Light*> nearest;
  for (const Light& light : lights) nearest.push_back(&light);
  const auto distance = [&](const Light* light) {
    return glm::dot(light->position_m - eye_m, light->position_m - eye_m);
  };
  std::stable_sort(nearest.begin(), nearest.end(),
                   [&](const Light* a, const Light* b) { return distance(a) < distance(b); });
  nearest.resize(std::min(nearest.size(), most));
  return nearest;
}

void set_beacons(ViewUniforms& uniforms, const Vec3& eye_m, std::span<const instant::BeaconLight> beacons) {
  const auto nearest = nearest_of(beacons, eye_m, most_beacons);
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    uniforms.beacon_position[i] = glm::vec4(glm::vec3(nearest[i]->position_m - eye_m), nearest[i]->ahead.x);
    uniforms.beacon_intensity[i] = glm::vec4(nearest[i]->intensity, nearest[i]->ahead.y);
  }
  uniforms.soot_size.w = static_cast<float>(nearest.size());
}

void set_headlights(ViewUniforms& uniforms, const Vec3& eye_m, std::span<const Headlight> headlights) {
  const auto nearest = nearest_of(headlights, eye_m, most_headlights);
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    uniforms.headlight_position[i] = glm::vec4(glm::vec3(nearest[i]->position_m - eye_m), nearest[i]->intensity);
    uniforms.headlight_direction[i] = glm::vec4(nearest[i]->direction, nearest[i]->main_beam);
  }
  uniforms.wind.z = static_cast<float>(nearest.size());
}

/// Sets the rows from points relative to the eye to the field's cells; a cell's value stands at its middle.
void set_soot(ViewUniforms& uniforms, const Vec3& eye_m, const SootField& soot) {
  const RigidTransform field_from_world = inverse(soot.world_from_field);
  const Vec3 eye = (field_from_world * eye_m) / soot.cell_m - 0.5;
  const glm::dmat3 turn = glm::mat3_cast(field_from_world.orientation) / soot.cell_m;
  glm::vec4* const rows[] = {&uniforms.soot_x, &uniforms.soot_y, &uniforms.soot_z};
  for (int c = 0; c < 3; ++c) *rows[c] = glm::vec4(turn[0][c], turn[1][c], turn[2][c], eye[c]);
  uniforms.soot_size = glm::vec4(soot.nx, soot.ny, soot.nz, 0.0f);
}

/// Place within a repeating tile, so that floats hold it.
glm::vec2 within_tile(const Vec3& place_m, double tile_m) {
  return {static_cast<float>(place_m.x - tile_m * std::floor(place_m.x / tile_m)),
          static_cast<float>(place_m.y - tile_m * std::floor(place_m.y / tile_m))};
}

void set_water(ViewUniforms& uniforms, const Vec3& eye_m, const Instant& instant, const RoadMirror& mirror) {
  if (instant.road)
    uniforms.road = glm::vec4(instant.road->normal,
                              static_cast<float>(glm::dot(Vec3(instant.road->normal), instant.road->point_m - eye_m)));
  uniforms.water = glm::vec4(within_tile(eye_m, light::puddle_tile_m), mirror.present ? 1.0f : 0.0f,
                             mirror.present && instant.environment.rain_mm_per_h > 0.0 ? 1.0f : 0.0f);
  uniforms.target = glm::vec4(1.0f / static_cast<float>(mirror.width), 1.0f / static_cast<float>(mirror.height),
                              within_tile(eye_m, light::ripple_tile_m));
}

}  // namespace

glm::dmat4 clip_from_relative(const FrameView& view) {
  const glm::dmat4 clip = view.projection.clip_from_eye_relative *
                          glm::dmat4(glm::mat4_cast(glm::conjugate(view.world_from_car.orientation)));
  return view.mirrored ? glm::dmat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1) * clip : clip;
}

double kept_depth(const FrameView& view) {
  const OffAxisView& projection = view.projection;
  return 1.0 - 2.0 * (projection.top_slope - projection.bottom_slope) / std::max(1u, view.viewport.height);
}

ViewUniforms view_uniforms(const FrameView& view, const Instant& instant, const ShadowCascades& shadows,
                           const LampField& lamps, const RoadMirror& mirror, const glm::vec2& offset_px) {
  const SkyLight& light = *instant.light;
  ViewUniforms uniforms{};
  const OffAxisView& projection = view.projection;
  const Quat world_from_car = view.world_from_car.orientation;
  uniforms.clip_from_relative = glm::mat4(clip_from_relative(view));
  const glm::vec2 size_px(std::max(1u, view.viewport.width), std::max(1u, view.viewport.height));
  uniforms.offset =
      glm::vec4(2.0f * offset_px / size_px, static_cast<float>(kept_depth(view)), casts_shadows(light) ? 1.0f : 0.0f);

  const Vec3 eye_m = world_eye(view);
  uniforms.shadow_from_relative = texture_from_relative(shadows.cascades[0], glm::vec3(eye_m - shadows.eye_m));
  uniforms.far_from_near = far_from_near(shadows);

  uniforms.light_direction = glm::vec4(light.light_direction, shadows.cascades[0].texel_m);
  uniforms.light_irradiance = glm::vec4(light.light_irradiance, instant.emission_share);
  uniforms.sky_irradiance = glm::vec4(light.sky_irradiance, instant.extinction_per_m * std::numbers::log2e_v<float>);
  uniforms.ground_irradiance = glm::vec4(light.ground_irradiance, light.night);
  uniforms.sun_direction = glm::vec4(light.sun_direction, shadows.cascades[1].texel_m);
  const glm::vec2 sun(light.sun_direction);
  const glm::vec2 sun_level = glm::length(sun) > 1e-6f ? glm::normalize(sun) : glm::vec2(1.0f, 0.0f);
  uniforms.sun_level = glm::vec4(sun_level, light.overcast, static_cast<float>(instant.environment.cloud_cover));

  for (std::size_t i = 0; i < light.irradiance.size(); ++i) {
    uniforms.irradiance[i] = glm::vec4(light.irradiance[i], 0.0f);
    uniforms.street_irradiance[i] = glm::vec4(light.street_irradiance[i], 0.0f);
  }

  uniforms.irradiance[0].w = lamps.roofed_height_m;

  // Ray of a pixel: the middle of the slopes, and half their spans along the screen's axes.
  const auto world = [&](const Vec3& axis) { return glm::vec4(glm::vec3(world_from_car * axis), 0.0f); };
  const double across = 0.5 * (projection.right_slope - projection.left_slope) * (view.mirrored ? -1.0 : 1.0);
  const double down = 0.5 * (projection.top_slope - projection.bottom_slope);
  uniforms.ray_middle =
      world(-projection.back + 0.5 * (projection.right_slope + projection.left_slope) * projection.right +
            0.5 * (projection.top_slope + projection.bottom_slope) * projection.up);
  uniforms.ray_right = world(across * projection.right);
  uniforms.ray_down = world(-down * projection.up);
  uniforms.billboard_right = world(projection.right);
  uniforms.billboard_right.w = static_cast<float>(2.0 * down / std::max(1u, view.viewport.height));
  uniforms.billboard_up = world(projection.up);

  const Environment& environment = instant.environment;
  uniforms.weather = glm::vec4(environment.road_wetness, environment.snow_cover,
                               std::fmod(instant.simulated_time_s, 3600.0), environment.rain_mm_per_h);
  uniforms.wind = glm::vec4(instant::cloud_drift_m(environment, instant.simulated_time_s), 0.0f, instant.share_of_sky);
  set_headlights(uniforms, eye_m, instant.headlights);
  if (!instant.soot.cover.empty()) set_soot(uniforms, eye_m, instant.soot);
  set_beacons(uniforms, eye_m, instant.beacons);
  constexpr double extent_m = LampField::side * LampField::texel_m;
  const glm::vec2 offset((Vec2(eye_m) - lamps.corner_m) / extent_m);
  uniforms.lamp_field = glm::vec4(offset, static_cast<float>(1.0 / extent_m), instant::open_lamps_light_up(light));
  uniforms.lamp_hue = glm::vec4(lamps.hue, instant::roofed_lamps_light_up);
  set_water(uniforms, eye_m, instant, mirror);
  return uniforms;
}

}  // namespace septet::render

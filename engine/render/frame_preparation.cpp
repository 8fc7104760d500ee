#include "engine/render/frame_preparation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/render/passes/contact_pass.hpp"
#include "engine/render/passes/dynamic_surfaces.hpp"
#include "engine/render/passes/glow_pass.hpp"
#include "engine/render/passes/light_clusters.hpp"
#include "engine/render/passes/precipitation_pass.hpp"
#include "engine/render/passes/smoke_pass.hpp"
#include "engine/render/passes/smoke_shade.hpp"
#include "engine/render/passes/view_uniforms.hpp"

namespace septet::render {
namespace {

/// Wetness that reflects, on a road that may be covered with snow except in the wheels' tracks (shaders/surface.frag).
float mirroring_wetness(const Environment& environment) {
  constexpr double snowed_share = 0.72;
  return static_cast<float>(environment.road_wetness * (1.0 - snowed_share * environment.snow_cover));
}

/// Smoke of all views of a frame.
struct PreparedSmoke {
  DrawnSmoke drawn;
  PreparedSmokeShade shade;
};

PreparedView prepare_view(PassContext& context, const DeviceScene& scene, const Instant& instant, const FrameView& view,
                          const ShadowCascades& shadows, const DynamicSurfaces& dynamic, const PreparedSmoke& smoke,
                          const LampField& lamps, const DetailOf& detail = {}, const RoadMirror& mirror = {},
                          const glm::vec2& offset_px = glm::vec2(0.0f)) {
  PreparedView prepared;
  prepared.view = &view;
  const Vec3 eye_m = world_eye(view);
  const ViewVolume volume = view_volume(view);
  // Meshes that would cover less than a pixel are left out.
  const OffAxisView& projection = view.projection;
  const double pixel_slope = (projection.top_slope - projection.bottom_slope) / std::max(1u, view.viewport.height);
  const auto least = static_cast<float>(0.5 * pixel_slope);
  const auto is_seen = [&](const PlacedMesh& mesh, const glm::vec3& centre_m) {
    return mesh.seen && mesh.radius_m * mesh.radius_m > least * least * glm::dot(centre_m, centre_m) &&
           intersects(volume, centre_m, mesh.radius_m);
  };
  prepared.draws = prepare_draws(
      context, scene, instant.parts, dynamic, eye_m, is_seen,
      [&](std::uint32_t material) { return material < scene.materials.size() ? material : no_group; }, detail, &volume);
  ViewUniforms uniforms = view_uniforms(view, instant, shadows, lamps, mirror, offset_px);
  set_smoke_shade(uniforms, smoke.shade.shade, eye_m);
  prepared.smoke_shade = smoke.shade.moments;
  prepared.lit_by_headlights = uniforms.wind.z > 0.0f;
  prepared.lit_by_lamps = lamps.shine(instant.light->street_lamps);
  prepared.mirrored_by_road = mirror.present;
  prepared.uniforms = store(context, std::span<const ViewUniforms>(&uniforms, 1));
  prepared.light_clusters = store_light_clusters(context, eye_m, instant.headlights);
  const std::vector<PuffRecord> puffs = puff_records(smoke.drawn, scene, *instant.light, view, eye_m);
  prepared.smoke = store(context, std::span<const PuffRecord>(puffs));
  prepared.puff_count = static_cast<std::uint32_t>(puffs.size());
  const std::vector<GlowRecord> glows =
      glow_records(instant.lamps, eye_m, instant.exposure.scale(),
                   [&](const Vec3& lamp_m) { return transmittance(smoke.drawn.puffs, eye_m, lamp_m); });
  prepared.glows = store(context, std::span<const GlowRecord>(glows));
  prepared.glow_count = static_cast<std::uint32_t>(glows.size());
  const std::vector<ContactRecord> contacts =
      contact_records(instant.contacts, eye_m, volume, static_cast<float>(pixel_slope));
  prepared.contacts = store(context, std::span<const ContactRecord>(contacts));
  prepared.contact_count = static_cast<std::uint32_t>(contacts.size());
  const std::vector<WetLampRecord> wet_lamps =
      wet_lamp_records(instant.lamps, eye_m, mirroring_wetness(instant.environment), instant.exposure.scale(),
                       instant.emission_share, mirror.present);
  prepared.wet_lamps = store(context, std::span<const WetLampRecord>(wet_lamps));
  prepared.wet_lamp_count = static_cast<std::uint32_t>(wet_lamps.size());
  const std::vector<StreakRecord> streaks = streak_records(instant, view, eye_m);
  prepared.streaks = store(context, std::span<const StreakRecord>(streaks));
  prepared.streak_count = static_cast<std::uint32_t>(streaks.size());
  context.statistics.instances += prepared.draws.instances;
  return prepared;
}

/// Levels of detail for a picture of a quarter of a turn, relative to the screen of a thousand pixels that they are
/// made for.
DetailOf surroundings_detail(std::uint32_t side_px) {
  const float times = std::max(1.0f, 512.0f / static_cast<float>(std::max(1u, side_px)));
  return {{0.0f, times}, {10.0f * times, times}};
}

/// Levels of detail for a mirror view, whose pixels are the wider the more the mirror bulges.
DetailOf mirror_detail(const FrameView& picture) {
  constexpr double usual_slope = 0.0015;  // Slope of a pixel of that screen.
  const OffAxisView& projection = picture.projection;
  const double slope = (projection.right_slope - projection.left_slope) / std::max(1u, picture.viewport.width);
  const auto times = static_cast<float>(std::clamp(1.3 * slope / usual_slope, 1.0, 6.0));
  return {{0.0f, times}, {10.0f * times, times}};
}

/// Least distance of a vehicle's level of detail, by cascade: a texel of the far cascade is no finer than the level at
/// this distance. In the near cascade the visible level casts, or the two would shade each other wherever they differ.
constexpr std::array<float, cascade_count> caster_ranges_m{0.0f, 200.0f};

/// Draws of the casters of shadows into a cascade that some view may see.
SurfaceDraws prepare_casters(PassContext& context, const DeviceScene& scene, const Instant& instant,
                             const ShadowCascades& shadows, std::size_t index, const DynamicSurfaces& dynamic) {
  const Cascade& cascade = shadows.cascades[index];
  const float least_radius_m = 1.5f * cascade.texel_m;
  // A shadow falls away from the light, at most as far as that of a high object at a low sun.
  const glm::vec3 reach = instant.light->light_direction * -120.0f;
  std::vector<std::pair<ViewVolume, glm::vec3>> volumes;
  const auto add_volume = [&](const FrameView& view) {
    volumes.emplace_back(view_volume(view), glm::vec3(shadows.eye_m - world_eye(view)));
  };
  for (const FrameView& view : instant.views) add_volume(view);
  for (const MirrorGlass& mirror : instant.mirrors) add_volume(mirror.picture);
  const auto casts = [&](const PlacedMesh& mesh, const glm::vec3& centre_m) {
    if (!mesh.casts_shadow || mesh.radius_m < least_radius_m || !covers(cascade, centre_m, mesh.radius_m)) return false;
    // Seen along the light, a shadow lies at its caster's place: casters wholly inside a finer cascade are drawn there
    // alone.
    if (index > 0 && holds(shadows.cascades[index - 1], centre_m, mesh.radius_m)) return false;
    return std::any_of(volumes.begin(), volumes.end(), [&](const auto& view) {
      const glm::vec3 from = centre_m + view.second, to = from + reach;
      return std::all_of(view.first.begin(), view.first.end(), [&](const glm::vec3& normal) {
        return std::max(glm::dot(normal, from), glm::dot(normal, to)) >= -mesh.radius_m;
      });
    });
  };
  // All solid materials cast alike: the first one stands for them.
  std::uint32_t solid = no_group;
  for (std::uint32_t i = 0; i < scene.materials.size() && solid == no_group; ++i)
    if (!scene.materials[i].cut && !scene.materials[i].blended) solid = i;
  return prepare_draws(context, scene, instant.parts, dynamic, shadows.eye_m, casts,
                       [&](std::uint32_t material) {
                         if (material >= scene.materials.size() || scene.materials[material].blended) return no_group;
                         return scene.materials[material].cut ? material : solid;
                       },
                       {{}, {caster_ranges_m[index], 1.0f}});
}

}  // namespace

PreparedFrame prepare_frame(PassContext& context, const DeviceScene& scene, const Instant& instant,
                            const LampField& lamps, std::uint32_t width, std::uint32_t height,
                            const glm::vec2& offset_px) {
  const Vec3 eye_m = world_eye(instant.views.front());
  const DynamicSurfaces dynamic = upload_dynamic(context, scene, instant);
  PreparedFrame frame;
  frame.shadows = shadow_cascades(eye_m, instant.light->light_direction);
  PreparedSmoke smoke{drawn_smoke(instant.smoke, instant.headlights, eye_m), {}};
  if (!smoke.drawn.puffs.empty()) {
    smoke.shade.shade = smoke_shade(smoke.drawn.puffs, scene.summary, frame.shadows);
    shade_smoke(smoke.drawn, smoke.shade.shade);
    if (casts_shadows(*instant.light)) smoke.shade.moments = store_smoke_shade(context, smoke.shade.shade);
  }
  if (road_mirrors(instant))
    frame.road_mirror =
        prepare_road_mirror(context, scene, instant, frame.shadows, smoke.shade, dynamic, lamps, width, height);
  for (const FrameView& view : instant.views)
    frame.views.push_back(prepare_view(context, scene, instant, view, frame.shadows, dynamic, smoke, lamps, {},
                                       {frame.road_mirror && frame.views.empty(), width, height}, offset_px));
  for (const MirrorGlass& mirror : instant.mirrors)
    frame.mirror_views.push_back(prepare_view(context, scene, instant, mirror.picture, frame.shadows, dynamic, smoke,
                                              lamps, mirror_detail(mirror.picture)));
  frame.mirrors = prepare_mirror_glass(context, instant.mirrors, eye_m);
  frame.ice = ice_tiles(instant.ice, instant.views, layer_px(width), layer_px(height));
  if (!frame.ice.list.empty()) {
    frame.ice_upload = upload_ice(context, instant.ice);
    for (const Vec3& middle_m : seen_neighbourhoods(ice_neighbourhoods(instant.ice, eye_m), frame.ice)) {
      const std::vector<FrameView> views = surrounding_views(middle_m, instant.ice_surroundings_px);
      frame.around.insert(frame.around.end(), views.begin(), views.end());
    }
    for (const FrameView& view : frame.around)
      frame.around_views.push_back(prepare_view(context, scene, instant, view, frame.shadows, dynamic, smoke, lamps,
                                                surroundings_detail(instant.ice_surroundings_px)));
  }
  frame.glass = upload_glass(context, instant.glass);
  if (!casts_shadows(*instant.light)) return frame;
  for (std::size_t i = 0; i < cascade_count; ++i)
    frame.casters[i] = prepare_casters(context, scene, instant, frame.shadows, i, dynamic);
  return frame;
}

}  // namespace septet::render

#include "engine/render/passes/road_mirror_pass.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include "engine/light/wet_road.hpp"
#include "engine/render/passes/dynamic_surfaces.hpp"
#include "engine/render/passes/frame_targets.hpp"
#include "engine/render/passes/light_clusters.hpp"
#include "engine/render/passes/shaders.hpp"
#include "engine/render/passes/whole_target.hpp"

namespace septet::render {
namespace {

/// Ranges of mirrored objects: farther away the road is not flat enough, and pixels are too small to tell.
constexpr float still_range_m = 120.0f, vehicle_range_m = 250.0f;
/// Levels of detail: an image of half the size, spread by the water, needs only those of greater distances.
constexpr DetailOf mirrored_detail{{0.0f, 3.0f}, {40.0f, 2.0f}};

/// Deviation of the tilts of the film's facets along the light's direction, rad, for stones of the film's roughness.
constexpr float film_spread_rad = 0.7f * light::film_roughness * light::film_roughness;

constexpr std::uint32_t half(std::uint32_t px) { return std::max(1u, (px + 1) / 2); }

PixelRectangle halved(const PixelRectangle& whole) {
  return {whole.x / 2, whole.y / 2, half(whole.width), half(whole.height)};
}

}  // namespace

bool road_mirrors(const Instant& instant) {
  return instant.environment.road_wetness > 0.0 && instant.road && instant.share_of_sky > 0.1f;
}

bool road_mirror_fits(const RoadMirrorPass& pass, std::uint32_t width, std::uint32_t height) {
  return pass.image.image != VK_NULL_HANDLE && pass.image.description.width == half(width) &&
         pass.image.description.height == half(height);
}

void prepare_road_mirror_targets(RoadMirrorPass& pass, vulkan::MemoryPool& memory, const TargetFormats& formats,
                                 std::uint32_t width, std::uint32_t height) {
  destroy_image(memory, pass.image);
  destroy_image(memory, pass.depth);
  destroy_image(memory, pass.spread);
  vulkan::ImageDescription description;
  description.width = half(width);
  description.height = half(height);
  description.format = formats.radiance;
  description.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  pass.image = create_image(memory, description);
  description.height = half(description.height);
  pass.spread = create_image(memory, description);
  description.height = half(height);
  description.format = formats.depth;
  description.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  description.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
  pass.depth = create_image(memory, description);
  pass.image_access = pass.depth_access = pass.spread_access = Access::none;
  if (pass.ripples.image != VK_NULL_HANDLE) return;
  description.width = description.height = instant::ripple_side;
  description.format = VK_FORMAT_R16G16_SFLOAT;
  description.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  description.aspect = VK_IMAGE_ASPECT_COLOR_BIT;
  pass.ripples = create_image(memory, description);
}

void destroy_road_mirror(RoadMirrorPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory) {
  destroy_surface_pass(pass.surfaces, device);
  if (pass.spreading) vkDestroyPipeline(device.device, pass.spreading, nullptr);
  for (vulkan::DeviceImage* image : {&pass.image, &pass.depth, &pass.spread, &pass.ripples})
    destroy_image(memory, *image);
  pass = {};
}

PreparedRoadMirror prepare_road_mirror(PassContext& context, const DeviceScene& scene, const Instant& instant,
                                       const ShadowCascades& shadows, const PreparedSmokeShade& shade,
                                       const DynamicSurfaces& dynamic, const LampField& lamps, std::uint32_t width,
                                       std::uint32_t height) {
  const FrameView& view = instant.views.front();
  const Vec3 eye_m = world_eye(view);
  const ViewVolume volume = view_volume(view);
  const OffAxisView& projection = view.projection;
  const double pixel_slope = (projection.top_slope - projection.bottom_slope) / std::max(1u, view.viewport.height);
  const auto least = static_cast<float>(2.0 * pixel_slope);
  const glm::vec3 up = instant.road->normal;
  const auto road = static_cast<float>(glm::dot(Vec3(up), instant.road->point_m - eye_m));
  const auto keep = [&](const PlacedMesh& mesh, const glm::vec3& centre_m) {
    const bool still = mesh.over_road_m <= 0.5f * PlacedMesh::unknown_road;
    const float distance_m = glm::length(centre_m);
    if (!mesh.seen || mesh.radius_m < least * distance_m) return false;
    // Static meshes without a shadow are ground.
    if (still && (!mesh.casts_shadow || distance_m - mesh.radius_m > still_range_m)) return false;
    if (distance_m - mesh.radius_m > vehicle_range_m) return false;
    const float plane = still ? road : glm::dot(up, centre_m - mesh.centre_m) - mesh.over_road_m;
    return intersects(volume, centre_m - up * (2.0f * (glm::dot(up, centre_m) - plane)), mesh.radius_m);
  };
  PreparedRoadMirror prepared;
  prepared.draws = prepare_draws(
      context, scene, instant.parts, dynamic, eye_m, keep,
      [&](std::uint32_t material) {
        return material < scene.materials.size() && !scene.materials[material].wettable ? material : no_group;
      },
      mirrored_detail);
  ViewUniforms uniforms = view_uniforms(view, instant, shadows, lamps, {false, width, height});
  set_smoke_shade(uniforms, shade.shade, eye_m);
  prepared.smoke_shade = shade.moments;
  prepared.lit_by_headlights = uniforms.wind.z > 0.0f;
  prepared.lit_by_lamps = lamps.shine(instant.light->street_lamps);
  prepared.uniforms = store(context, std::span<const ViewUniforms>(&uniforms, 1));
  prepared.light_clusters = store_light_clusters(context, eye_m, instant.headlights);
  return prepared;
}

void draw_road_mirror(RoadMirrorPass& pass, PassContext& context, const DeviceScene& scene,
                      const PreparedRoadMirror& prepared, const FrameView& view, const ViewBindings& bindings,
                      const FrameData& soot, const SurfaceLight& light) {
  TargetFormats formats = context.formats;
  formats.samples = VK_SAMPLE_COUNT_1_BIT;
  PassContext mirror{context.device, context.memory, context.layout,     context.samplers,
                     formats,        context.slot,   context.statistics, context.refinements};
  begin_view_rendering(mirror, pass.image, pass.depth, 0.0f);
  set_viewport(mirror, halved(view.viewport));
  // Front faces turn the other way round in an image upside down.
  vkCmdSetFrontFace(context.slot.commands, view.mirrored ? VK_FRONT_FACE_COUNTER_CLOCKWISE : VK_FRONT_FACE_CLOCKWISE);
  ViewBindings own = bindings;
  own.uniforms = prepared.uniforms;
  own.light_clusters = prepared.light_clusters;
  own.smoke_shade = prepared.smoke_shade;
  own.road_mirror = VK_NULL_HANDLE;
  push_view(mirror, own);
  bind_instances(mirror, prepared.draws.records);
  push_records(mirror, soot);
  SurfaceLight mirrored = light;
  mirrored.mirror_of_road = true;
  for (const SurfaceKind kind : {SurfaceKind::opaque, SurfaceKind::cut, SurfaceKind::blended})
    draw_surfaces(pass.surfaces, mirror, scene, prepared.draws, kind, mirrored);
  vkCmdEndRendering(context.slot.commands);
}

void spread_road_mirror(RoadMirrorPass& pass, PassContext& context, const FrameView& view) {
  if (!pass.spreading)
    pass.spreading = create_whole_target_pipeline(context.device, context.layout, context.formats.radiance,
                                                  shaders::road_mirror_spread_frag(), vulkan::Blend::data);
  const OffAxisView& projection = view.projection;
  const auto texels_per_rad =
      static_cast<float>(halved(view.viewport).height / std::max(1e-3, projection.top_slope - projection.bottom_slope));
  const auto [width, height] = std::pair(pass.spread.description.width, pass.spread.description.height);
  draw_whole_target(pass.spreading, context, pass.image.view, pass.spread.view, width, height,
                    glm::vec4(width, height, film_spread_rad * texels_per_rad, 0.0f));
}

void upload_ripples(const RoadMirrorPass& pass, PassContext& context, const Instant& instant) {
  const std::vector<glm::vec2> slopes =
      instant::ripple_slopes(instant.environment.rain_mm_per_h, instant.simulated_time_s);
  std::vector<std::uint32_t> texels(slopes.size());
  std::ranges::transform(slopes, texels.begin(), [](const glm::vec2& slope) { return glm::packHalf2x16(slope); });
  upload_texels(context, pass.ripples, std::as_bytes(std::span(texels)));
}

}  // namespace septet::render

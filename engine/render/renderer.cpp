#include "engine/render/renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include "engine/core/check.hpp"
#include "engine/effects/ice/air_pattern.hpp"
#include "engine/instant/clouds.hpp"
#include "engine/render/frame_preparation.hpp"
#include "engine/render/graph/render_graph.hpp"
#include "engine/render/ice_frame.hpp"
#include "engine/render/passes/bloom_pass.hpp"
#include "engine/render/passes/contact_pass.hpp"
#include "engine/render/passes/device_scene.hpp"
#include "engine/render/passes/frame_targets.hpp"
#include "engine/render/passes/glow_pass.hpp"
#include "engine/render/passes/ice_pass.hpp"
#include "engine/render/passes/lamp_field.hpp"
#include "engine/render/passes/mirror_pass.hpp"
#include "engine/render/passes/overlay_pass.hpp"
#include "engine/render/passes/precipitation_pass.hpp"
#include "engine/render/passes/road_mirror_pass.hpp"
#include "engine/render/passes/shadow_pass.hpp"
#include "engine/render/passes/sky_pass.hpp"
#include "engine/render/passes/smoke_pass.hpp"
#include "engine/render/passes/smoothing_pass.hpp"
#include "engine/render/passes/surface_pass.hpp"
#include "engine/render/passes/tone_mapping_pass.hpp"
#include "engine/render/vulkan/swapchain.hpp"
#include "engine/render/window.hpp"
#include "engine/render/window_surface.hpp"

namespace septet::render {
namespace {

Expected<void> check_size(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint32_t largest = 16384;
  if (width > 0 && height > 0 && width <= largest && height <= largest) return {};
  return failure(fmt::format("the picture is {} × {} pixels", width, height), "screen size",
                 fmt::format("give a width and height from 1 to {} pixels", largest));
}

}  // namespace

struct Renderer::State {
  RendererOptions options;
  vulkan::Device device;
  vulkan::MemoryPool memory;
  vulkan::FrameRing ring;
  vulkan::PipelineLayout layout;
  Samplers samplers;
  TargetFormats formats;
  FrameTargets targets;
  vulkan::Swapchain swapchain;  ///< Only with a window.
  vulkan::DeviceImage sky_table, noise, lamp_image;
  LampField lamps;                              ///< What the image holds; its texels while they are new.
  std::optional<std::uint64_t> lamps_revision;  ///< Of the scene whose lamps they are.
  DeviceScene scene;
  SurfacePass surface_pass;
  ShadowPass shadow_pass;
  SkyPass sky_pass;
  ContactPass contact_pass;
  GlowPass glow_pass;
  PrecipitationPass precipitation_pass;
  SmokePass smoke_pass;
  RoadMirrorPass road_mirror_pass;
  MirrorPass mirror_pass;
  IcePass ice_pass;
  BloomPass bloom_pass;
  ToneMappingPass tone_mapping_pass;
  SmoothingPass smoothing_pass;
  std::optional<OverlayPass> overlay_pass;
  std::optional<Environment> lit_environment;
  std::shared_ptr<const SkyLight> light;  ///< Of that environment, for whoever brings none.
  Access sky_table_access = Access::none, lamps_access = Access::none, atlas_access = Access::none;
  bool smoothed = false;
  bool drawn = false;
  Exposure exposure;                            ///< Of the last frame.
  std::shared_ptr<const SkyLight> table_light;  ///< Whose sky the table holds.
  RenderStatistics statistics;

  ~State() { destroy(); }
  void create(const RendererOptions& wanted);
  void destroy();
  void draw(const Instant& instant);
  bool renew_lamps(const Vec3& eye_m);
  std::optional<std::uint32_t> next_window_image(const vulkan::FrameSlot& slot);
  void draw_view(PassContext& context, const PreparedView& prepared, const Instant& instant, const FrameData& soot,
                 const std::function<void()>& draw_seen_through, const PreparedGlass& mirrors = {});
  ViewBindings view_bindings() const {
    return {{}, sky_table.view, targets.shadow_map.view, noise.view, lamp_image.view};
  }
  void draw_views(PassContext& context, const PreparedFrame& frame, const Instant& instant);
  void draw_surroundings(PassContext& context, std::span<const PreparedView> views, const Instant& instant);
  void draw_mirrors(PassContext& context, const PreparedFrame& frame, const Instant& instant);
};

void Renderer::State::create(const RendererOptions& wanted) {
  options = wanted;
  memory.device = &device;
  vulkan::DeviceOptions device_options{wanted.device == DevicePreference::software, wanted.validation, {}, {}};
  if (wanted.window) add_window(device_options, *wanted.window);
  create_device(device, device_options);
  const VkSampleCountFlags samples =
      device.properties.limits.framebufferColorSampleCounts & device.properties.limits.framebufferDepthSampleCounts &
      device.properties.limits.sampledImageColorSampleCounts & device.properties.limits.sampledImageDepthSampleCounts;
  const bool software = device.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  Antialiasing antialiasing = wanted.antialiasing;
  if (antialiasing == Antialiasing::automatic)
    antialiasing = software ? Antialiasing::smoothing : Antialiasing::multisampled;
  const bool multisampled = antialiasing == Antialiasing::multisampled && (samples & VK_SAMPLE_COUNT_4_BIT);
  formats.samples = multisampled ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
  smoothed = antialiasing == Antialiasing::smoothing;
  create_frame_ring(ring, device, wanted.timed);
  create_pipeline_layout(layout, device);
  create_samplers(samplers, device);
  create_frame_targets(targets, memory, formats, wanted.width, wanted.height, smoothed);
  vulkan::ImageDescription table;
  table.width = SkyTable::columns;
  table.height = SkyTable::rows;
  table.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  table.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  sky_table = create_image(memory, table);
  table.width = table.height = LampField::side;
  lamp_image = create_image(memory, table);
  vulkan::Upload upload(device, memory);
  constexpr std::uint32_t side = instant::cloud_noise_side;
  const std::vector<std::uint8_t> ranks = instant::cloud_noise(), air = ice::air_pattern(ranks, side);
  std::vector<std::uint8_t> texels;
  for (std::size_t i = 0; i < ranks.size(); ++i) texels.insert(texels.end(), {ranks[i], air[i], ranks[i], ranks[i]});
  noise = create_texture(upload, texture_levels(side, side, texels, false));
  upload.finish();
  create_shadow_pass(shadow_pass, device, layout, formats.depth);
  create_contact_pass(contact_pass, device, layout, formats);
  create_glow_pass(glow_pass, device, layout, formats);
  create_mirror_pass(mirror_pass, device, layout, formats);
  create_precipitation_pass(precipitation_pass, device, layout, formats);
  create_smoke_pass(smoke_pass, device, layout, formats);
  if (wanted.bloom == Bloom::present || (wanted.bloom == Bloom::automatic && !software)) {
    create_bloom_pass(bloom_pass, device, layout, formats);
    create_bloom_targets(bloom_pass, memory, formats, wanted.width, wanted.height);
  }
  create_tone_mapping_pass(tone_mapping_pass, device, layout, formats);
  create_smoothing_pass(smoothing_pass, device, layout, formats.picture);
  Expected<image::Font> font = image::Font::find(image::FontStyle::bold);
  if (!font) throw vulkan::Failure{font.error()};
  overlay_pass.emplace(OverlayPass{VK_NULL_HANDLE, std::move(*font), {}, {}, {}});
  create_overlay_pass(*overlay_pass, device, memory, layout, formats);
}

void Renderer::State::destroy() {
  if (!device.device) {
    destroy_device(device);
    return;
  }
  vkDeviceWaitIdle(device.device);
  if (overlay_pass) destroy_overlay_pass(*overlay_pass, device, memory);
  destroy_smoothing_pass(smoothing_pass, device);
  destroy_tone_mapping_pass(tone_mapping_pass, device);
  destroy_bloom_pass(bloom_pass, device, memory);
  destroy_ice_pass(ice_pass, device, memory);
  destroy_road_mirror(road_mirror_pass, device, memory);
  destroy_mirror_pass(mirror_pass, device, memory);
  destroy_smoke_pass(smoke_pass, device);
  destroy_precipitation_pass(precipitation_pass, device);
  destroy_contact_pass(contact_pass, device);
  destroy_glow_pass(glow_pass, device);
  destroy_sky_pass(sky_pass, device);
  destroy_shadow_pass(shadow_pass, device);
  destroy_surface_pass(surface_pass, device);
  destroy_scene(scene, memory);
  destroy_image(memory, noise);
  destroy_image(memory, lamp_image);
  destroy_image(memory, sky_table);
  destroy_frame_targets(targets, memory);
  destroy_swapchain(swapchain, device);
  destroy_samplers(samplers, device);
  destroy_pipeline_layout(layout, device);
  destroy_frame_ring(ring, device, memory);
  destroy_memory(memory);
  destroy_device(device);
}

namespace {
SurfaceLight surface_light_of(const Instant& instant, bool lit_by_headlights, bool lit_by_lamps) {
  return {instant.environment.road_wetness > 0.0, lit_by_headlights, lit_by_lamps, instant.environment.snow_cover > 0.0,
          !instant.soot.cover.empty()};
}
}  // namespace

void Renderer::State::draw_view(PassContext& context, const PreparedView& prepared, const Instant& instant,
                                const FrameData& soot, const std::function<void()>& draw_seen_through,
                                const PreparedGlass& mirrors) {
  const Environment& environment = instant.environment;
  set_viewport(context, prepared.view->viewport);
  vkCmdSetFrontFace(context.slot.commands,
                    prepared.view->mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
  ViewBindings bindings = view_bindings();
  bindings.uniforms = prepared.uniforms;
  if (prepared.mirrored_by_road) {
    bindings.road_mirror = road_mirror_pass.image.view;
    bindings.ripples = road_mirror_pass.ripples.view;
  }
  push_view(context, bindings);
  bind_instances(context, prepared.draws.records);
  const SurfaceLight surface_light = surface_light_of(instant, prepared.lit_by_headlights, prepared.lit_by_lamps);
  push_records(context, soot);
  draw_surfaces(surface_pass, context, scene, prepared.draws, SurfaceKind::opaque, surface_light);
  if (mirrors.count > 0) {
    draw_mirror_glass(mirror_pass, context, mirrors);
    push_records(context, soot);
  }
  mark_pass(context, "opaque");
  draw_surfaces(surface_pass, context, scene, prepared.draws, SurfaceKind::cut, surface_light);
  mark_pass(context, "cut-outs");
  draw_surfaces(surface_pass, context, scene, prepared.draws, SurfaceKind::stripe, surface_light);
  mark_pass(context, "stripes");
  if (prepared.contact_count > 0) {
    draw_contacts(contact_pass, context, prepared.contacts, prepared.contact_count);
    push_records(context, soot);
  }
  mark_pass(context, "contact shadows");
  draw_sky(sky_pass, context, environment.cloud_cover > 0.0, instant.light->night > 0.0f);
  mark_pass(context, "sky");
  draw_seen_through();
  mark_pass(context, "ice and glass");
  draw_surfaces(surface_pass, context, scene, prepared.draws, SurfaceKind::blended, surface_light);
  mark_pass(context, "blended");
  draw_wet_lamps(glow_pass, context, prepared.wet_lamps, prepared.wet_lamp_count);
  mark_pass(context, "wet lamps");
  draw_smoke(smoke_pass, context, prepared.smoke, prepared.puff_count);
  mark_pass(context, "smoke");
  draw_glows(glow_pass, context, prepared.glows, prepared.glow_count);
  mark_pass(context, "glows");
  draw_precipitation(precipitation_pass, context, prepared.streaks, prepared.streak_count);
  mark_pass(context, "precipitation");
}

void Renderer::State::draw_views(PassContext& context, const PreparedFrame& frame, const Instant& instant) {
  const FrameData soot = store(context, std::span<const std::uint8_t>(instant.soot.cover));
  begin_view_rendering(context, targets.radiance, targets.depth);
  for (std::uint32_t i = 0; i < frame.views.size(); ++i) {
    const PreparedView& prepared = frame.views[i];
    if (i > 0) clear_inset(context, targets, prepared.view->viewport);
    const Vec3 eye_m = world_eye(*prepared.view);
    draw_view(
        context, prepared, instant, soot,
        [&] {
          if (frame.ice.list.empty() && instant.glass.empty()) return;
          if (!frame.ice.list.empty()) draw_ice(ice_pass, context, frame.ice, i, instant.ice, frame.ice_upload);
          draw_glass(ice_pass, context, instant.glass, frame.glass, eye_m, false);
          // Ice has no instances and its own constants; what follows has both.
          bind_instances(context, prepared.draws.records);
        },
        i == 0 ? frame.mirrors : PreparedGlass{});
    draw_glass(ice_pass, context, instant.glass, frame.glass, eye_m, true);
  }
  vkCmdEndRendering(context.slot.commands);
}

void Renderer::State::draw_surroundings(PassContext& context, std::span<const PreparedView> views,
                                        const Instant& instant) {
  const FrameData soot = store(context, std::span<const std::uint8_t>(instant.soot.cover));
  begin_view_rendering(context, ice_pass.targets[IceImage::around], ice_pass.targets[IceImage::around_depth]);
  for (const PreparedView& prepared : views) draw_view(context, prepared, instant, soot, [] {});
  vkCmdEndRendering(context.slot.commands);
}

void Renderer::State::draw_mirrors(PassContext& context, const PreparedFrame& frame, const Instant& instant) {
  const FrameData soot = store(context, std::span<const std::uint8_t>(instant.soot.cover));
  begin_mirror_rendering(mirror_pass, context, instant.mirrors);
  for (const PreparedView& prepared : frame.mirror_views) draw_view(context, prepared, instant, soot, [] {});
  vkCmdEndRendering(context.slot.commands);
}

/// Whether the field of lamps is another one than the last frame's. The first one is always written, so that it can be bound.
bool Renderer::State::renew_lamps(const Vec3& eye_m) {
  const Vec2 corner_m = lamp_field_corner(eye_m);
  if (lamps_revision && lamps_revision == scene.revision.value_or(0) && corner_m == lamps.corner_m) return false;
  const bool were_there = !lamps_revision || lamps.open || lamps.roofed;
  lamps = render::lamp_field(scene.summary.lamps, corner_m);
  lamps_revision = scene.revision.value_or(0);
  if (lamps.texels.empty() && were_there)
    lamps.texels.resize(std::size_t{LampField::side} * LampField::side, glm::vec4(0.0f));
  return !lamps.texels.empty();
}

std::optional<std::uint32_t> Renderer::State::next_window_image(const vulkan::FrameSlot& slot) {
  if (!options.window) return std::nullopt;
  if (swapchain.stale) {
    vkDeviceWaitIdle(device.device);
    renew_swapchain(swapchain, device, options.window->width(), options.window->height());
  }
  return acquire(swapchain, device, slot.image_acquired);
}

void Renderer::State::draw(const Instant& instant) {
  statistics.triangles = statistics.shadow_triangles = statistics.draws = statistics.instances = 0;
  PassContext context{device, memory, layout, samplers, formats, begin_frame(ring, device), statistics};

  statistics.pass_times = begin_pass_marks(context.slot.marks, device, context.slot.commands);

  const bool new_light = table_light != instant.light;
  table_light = instant.light;
  exposure = instant.exposure;

  const bool new_lamps = renew_lamps(world_eye(instant.views.front()));
  const PreparedFrame frame = prepare_frame(context, scene, instant, lamps, targets.width, targets.height);
  const bool new_text = lay_out(*overlay_pass, instant.overlay);
  const bool icy = !frame.ice.list.empty();
  const IceTargetSizes ice_sizes{layer_px(targets.width), layer_px(targets.height), instant.ice_surroundings_px,
                                 frame.surroundings(), frame.ice.beyond};
  if (icy && !ice_targets_fit(ice_pass, ice_sizes)) {
    wait_for_frames(ring, device);
    prepare_ice_targets(ice_pass, context, ice_sizes);
  }

  if (frame.road_mirror && !road_mirror_fits(road_mirror_pass, targets.width, targets.height)) {
    wait_for_frames(ring, device);
    prepare_road_mirror_targets(road_mirror_pass, memory, formats, targets.width, targets.height);
  }

  if (!instant.mirrors.empty() && !mirrors_fit(mirror_pass, instant.mirrors)) {
    wait_for_frames(ring, device);
    prepare_mirror_targets(mirror_pass, memory, formats, instant.mirrors);
  }

  RenderGraph graph;
  std::vector<vulkan::ImageBarrier> images;  // By resource.
  const auto add_image = [&](const char* name, const vulkan::DeviceImage& image, Access held) {
    images.push_back({&image, VK_NULL_HANDLE, Access::none, Access::none, false});
    return graph.add_resource(name, held);
  };
  const ResourceId table = add_image("sky table", sky_table, sky_table_access);
  const ResourceId lamp_field = add_image("lamp field", lamp_image, lamps_access);
  const ResourceId shadow_map = add_image("shadow map", targets.shadow_map, targets.shadow_access);
  const ResourceId radiance = add_image("radiance", targets.radiance, targets.radiance_access);
  const ResourceId depth = add_image("depth", targets.depth, targets.depth_access);
  const ResourceId picture = add_image("picture", targets.picture, targets.picture_access);
  const ResourceId atlas = add_image("text atlas", overlay_pass->atlas, atlas_access);
  std::optional<ResourceId> mapped;
  if (targets.smoothed()) mapped = add_image("before smoothing", targets.mapped, targets.mapped_access);

  if (new_light)
    graph.add_pass("sky table", {{}, {{table, Access::transfer_destination}}}, [&] {
      const std::vector<std::uint64_t> texels = packed(instant.light->table);
      upload_texels(context, sky_table, std::as_bytes(std::span(texels)));
    });
  if (new_lamps)
    graph.add_pass("lamp field", {{}, {{lamp_field, Access::transfer_destination}}}, [&] {
      const std::vector<std::uint64_t> texels = packed(lamps);
      upload_texels(context, lamp_image, std::as_bytes(std::span(texels)));
    });
  graph.add_pass("shadows", {{}, {{shadow_map, Access::depth_attachment}}}, [&] {
    for (std::size_t i = 0; i < cascade_count; ++i)
      draw_shadows(shadow_pass, context, scene, frame.casters[i], frame.shadows.cascades[i],
                   targets.shadow_map.layer_views[i]);
    mark_pass(context, "shadows");
  });
  std::vector<ResourceUse> view_reads{
      {table, Access::sampled}, {shadow_map, Access::sampled}, {lamp_field, Access::sampled}};
  std::array<ResourceId, 3> mirror{};  // Image, depth, ripples.
  if (frame.road_mirror) {
    mirror = {add_image("road mirror", road_mirror_pass.image, road_mirror_pass.image_access),
              add_image("road mirror depth", road_mirror_pass.depth, road_mirror_pass.depth_access),
              add_image("ripples", road_mirror_pass.ripples, road_mirror_pass.ripples_access)};
    graph.add_pass("ripples", {{}, {{mirror[2], Access::transfer_destination}}},
                   [&] { upload_ripples(road_mirror_pass, context, instant); });
    graph.add_pass(
        "road mirror", {view_reads, {{mirror[0], Access::color_attachment}, {mirror[1], Access::depth_attachment}}},
        [&] {
          draw_road_mirror(
              road_mirror_pass, context, scene, *frame.road_mirror, instant.views.front(), view_bindings(),
              store(context, std::span<const std::uint8_t>(instant.soot.cover)),
              surface_light_of(instant, frame.road_mirror->lit_by_headlights, frame.road_mirror->lit_by_lamps));
          mark_pass(context, "road mirror");
        });
    view_reads.push_back({mirror[0], Access::sampled});
    view_reads.push_back({mirror[2], Access::sampled});
  }
  std::array<ResourceId, 3> mirrors{};  // Picture, samples, depth.
  if (!frame.mirror_views.empty()) {
    mirrors = {add_image("mirrors", mirror_pass.picture, mirror_pass.picture_access),
               add_image("samples of mirrors", mirror_pass.samples, mirror_pass.samples_access),
               add_image("depth of mirrors", mirror_pass.depth, mirror_pass.depth_access)};
    std::vector<ResourceUse> writes{{mirrors[0], Access::color_attachment}, {mirrors[2], Access::depth_attachment}};
    if (mirror_pass.multisampled()) writes.push_back({mirrors[1], Access::color_attachment});
    graph.add_pass("mirrors", {view_reads, writes}, [&] {
      draw_mirrors(context, frame, instant);
      mark_pass(context, "mirrors");
    });
    view_reads.push_back({mirrors[0], Access::sampled});
  }
  std::optional<IceResources> ice;
  if (icy) {
    ice = add_ice_passes(
        graph, ice_pass, context, frame, instant,
        {add_image,
         view_reads,
         {frame.views.front().uniforms, sky_table.view, targets.shadow_map.view, noise.view, lamp_image.view},
         [&](std::uint32_t around) {
           draw_surroundings(context, std::span(frame.around_views).subspan(6 * around, 6), instant);
         }});
    for (const ResourceUse& use : ice_reads(*ice, frame)) view_reads.push_back(use);
  }
  graph.add_pass("views", {view_reads, {{radiance, Access::color_attachment}, {depth, Access::depth_attachment}}},
                 [&] { draw_views(context, frame, instant); });
  std::optional<std::array<ResourceId, bloom_levels>> bloom;
  if (bloom_pass.present()) bloom = add_bloom_passes(graph, bloom_pass, context, add_image, radiance, targets.radiance);
  graph.add_pass("tone mapping",
                 {{{radiance, Access::sampled}}, {{mapped.value_or(picture), Access::color_attachment}}}, [&] {
                   draw_tone_mapped(tone_mapping_pass, context, targets.radiance.view,
                                    targets.smoothed() ? targets.mapped.view : targets.picture.view, targets.width,
                                    targets.height, instant.exposure.scale());
                   mark_pass(context, "tone mapping");
                 });
  if (mapped)
    graph.add_pass("smoothing", {{{*mapped, Access::sampled}}, {{picture, Access::color_attachment}}}, [&] {
      draw_smoothed(smoothing_pass, context, targets.mapped.view, targets.picture.view, targets.width, targets.height);
      mark_pass(context, "smoothing");
    });
  if (new_text)
    graph.add_pass("text atlas", {{}, {{atlas, Access::transfer_destination}}},
                   [&] { upload_atlas(*overlay_pass, context); });
  if (!instant.overlay.empty())
    graph.add_pass(
        "overlay",
        {{{atlas, Access::sampled}, {picture, Access::color_attachment}}, {{picture, Access::color_attachment}}}, [&] {
          draw_overlay(*overlay_pass, context, instant.overlay, targets.picture.view, targets.width, targets.height);
          mark_pass(context, "overlay");
        });
  graph.keep(picture, Access::transfer_source);
  const std::optional<std::uint32_t> window_image = next_window_image(context.slot);
  if (window_image) {
    images.push_back({nullptr, swapchain.images[*window_image], Access::none, Access::none, false});
    const ResourceId window = graph.add_resource("window", Access::present);
    graph.add_pass("present", {{{picture, Access::transfer_source}}, {{window, Access::transfer_destination}}},
                   [&] { record_copy(context.slot.commands, targets.picture, swapchain, *window_image); });
    graph.keep(window, Access::present);
  }

  graph.execute([&](std::span<const Barrier> barriers) {
    std::vector<vulkan::ImageBarrier> list;
    for (const Barrier& barrier : barriers) {
      list.push_back(images[barrier.resource]);
      list.back().before = barrier.before;
      list.back().after = barrier.after;
      list.back().discard = barrier.discard;
    }
    record_barriers(context.slot.commands, list);
  });
  const std::vector<Access> left = graph.left(graph.compile());
  sky_table_access = left[table];
  lamps_access = left[lamp_field];
  lamps.texels.clear();
  targets.shadow_access = left[shadow_map];
  targets.depth_access = left[depth];
  targets.picture_access = left[picture];
  atlas_access = left[atlas];
  targets.radiance_access = left[radiance];
  if (ice)
    for (std::size_t i = 0; i < ice_image_count; ++i) ice_pass.targets.accesses[i] = left[(*ice)[i]];
  if (bloom)
    for (std::size_t i = 0; i < bloom_levels; ++i) bloom_pass.accesses[i] = left[(*bloom)[i]];
  if (mapped) targets.mapped_access = left[*mapped];
  if (frame.road_mirror) {
    road_mirror_pass.image_access = left[mirror[0]];
    road_mirror_pass.depth_access = left[mirror[1]];
    road_mirror_pass.ripples_access = left[mirror[2]];
  }
  if (!frame.mirror_views.empty()) {
    mirror_pass.picture_access = left[mirrors[0]];
    mirror_pass.samples_access = left[mirrors[1]];
    mirror_pass.depth_access = left[mirrors[2]];
  }
  if (window_image) {
    submit(ring, context.slot, device, {context.slot.image_acquired, swapchain.finished[*window_image]});
    present(swapchain, device, *window_image);
  } else {
    submit(ring, context.slot, device);
  }
  drawn = true;
  if (device.validation_log) {
    statistics.validation_messages = device.validation_log->messages;
    const std::lock_guard lock(device.validation_log->mutex);
    statistics.first_validation_message = device.validation_log->first;
  }
}

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Expected<Renderer> Renderer::create(const RendererOptions& options) {
  if (auto possible = check_size(options.width, options.height); !possible) return tl::unexpected(possible.error());
  auto state = std::make_unique<State>();
  try {
    state->create(options);
  } catch (const vulkan::Failure& refused) {
    return tl::unexpected(refused.error);
  }
  return Renderer(std::move(state));
}

Expected<void> Renderer::upload(const scene::ResolvedScene& scene) {
  if (state_->scene.revision == scene.revision) return {};
  try {
    wait_for_frames(state_->ring, state_->device);
    upload_scene(state_->scene, scene, state_->device, state_->memory);
  } catch (const vulkan::Failure& refused) {
    return tl::unexpected(refused.error);
  }
  return {};
}

Expected<void> Renderer::resize(std::uint32_t width, std::uint32_t height) {
  if (auto possible = check_size(width, height); !possible) return possible;
  if (width == state_->targets.width && height == state_->targets.height) return {};
  try {
    wait_for_frames(state_->ring, state_->device);
    destroy_frame_targets(state_->targets, state_->memory);
    create_frame_targets(state_->targets, state_->memory, state_->formats, width, height, state_->smoothed);
    if (state_->bloom_pass.present()) {
      destroy_bloom_targets(state_->bloom_pass, state_->memory);
      create_bloom_targets(state_->bloom_pass, state_->memory, state_->formats, width, height);
    }
    state_->drawn = false;
    state_->swapchain.stale = true;
  } catch (const vulkan::Failure& refused) {
    return tl::unexpected(refused.error);
  }
  return {};
}

Expected<void> Renderer::draw(const Instant& instant) {
  for (const MirrorGlass& mirror : instant.mirrors)
    SEPTET_CHECK(mirror.picture.viewport.x >= 0 && mirror.picture.viewport.y >= 0, "a mirror's picture at ({}, {})",
                 mirror.picture.viewport.x, mirror.picture.viewport.y);
  for (const FrameView& view : instant.views) {
    const auto& [x, y, w, h] = view.viewport;
    SEPTET_CHECK(
        x >= 0 && y >= 0 && w > 0 && h > 0 && x + std::int64_t{w} <= width() && y + std::int64_t{h} <= height(),
        "a view of {} × {} pixels at ({}, {}) in a picture of {} × {}", w, h, x, y, width(), height());
  }
  try {
    state_->draw(instant);
  } catch (const vulkan::Failure& refused) {
    return tl::unexpected(refused.error);
  }
  return {};
}

Expected<void> Renderer::draw(FrameInput input) {
  if (state_->lit_environment != input.environment) {
    state_->light = std::make_shared<const SkyLight>(sky_light(input.environment));
    state_->lit_environment = input.environment;
  }
  return draw(instant::describe(std::move(input), state_->scene.summary, state_->light));
}

Expected<image::Image> Renderer::read_back() {
  image::Image picture(state_->targets.width, state_->targets.height);
  if (!state_->drawn) return picture;
  try {
    read_picture(state_->targets, state_->device, state_->memory, picture.rgba);
  } catch (const vulkan::Failure& refused) {
    return tl::unexpected(refused.error);
  }
  return picture;
}

Exposure Renderer::exposure() const { return state_->exposure; }

Expected<RadianceImage> Renderer::read_radiance() {
  RadianceImage result{state_->targets.width, state_->targets.height, {}};
  result.radiance.resize(std::size_t{result.width} * result.height, glm::vec3(0.0f));
  if (!state_->drawn) return result;
  std::vector<std::uint64_t> halves(result.radiance.size());
  try {
    render::read_radiance(state_->targets, state_->device, state_->memory, halves);
  } catch (const vulkan::Failure& refused) {
    return tl::unexpected(refused.error);
  }
  std::ranges::transform(halves, result.radiance.begin(),
                         [](std::uint64_t half) { return glm::vec3(glm::unpackHalf4x16(half)); });
  return result;
}

std::uint32_t Renderer::width() const { return state_->targets.width; }
std::uint32_t Renderer::height() const { return state_->targets.height; }
const RenderStatistics& Renderer::statistics() const { return state_->statistics; }
std::string_view Renderer::device_name() const { return state_->device.properties.deviceName; }

}  // namespace septet::render

#include "engine/render/frame_order.hpp"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "engine/render/frame_preparation.hpp"
#include "engine/render/ice_frame.hpp"
#include "engine/render/passes/frame_graph.hpp"
#include "engine/render/passes/inset_housing.hpp"
#include "engine/render/view_drawing.hpp"
#include "engine/render/window.hpp"

namespace septet::render {
namespace {

/// Frame while its passes are added. Their recording functions refer to it until the graph has been recorded.
struct Frame {
  RendererState& state;
  PassContext& context;
  const Instant& instant;
  const PreparedFrame prepared;
  const std::vector<light::QuadConstants> housings;
  FrameGraph graph;
  std::vector<ResourceUse> view_reads;  ///< Reads of a view, for the passes added so far.
};

/// Renews the field of lamps; true if it differs from the last frame's. The first one is always written, so that it can
/// be bound.
bool renew_lamps(RendererState& state, const Vec3& eye_m) {
  LampField& lamps = state.lamps;
  const Vec2 corner_m = lamp_field_corner(eye_m);
  const std::uint64_t revision = state.scene.lamps_revision;
  if (state.lamps_revision && state.lamps_revision == revision && corner_m == lamps.corner_m) return false;
  const bool were_there = !state.lamps_revision || lamps.open || lamps.roofed;
  lamps = lamp_field(state.scene.summary.lamps, corner_m);
  state.lamps_revision = revision;
  if (lamps.texels.empty() && were_there)
    lamps.texels.resize(std::size_t{LampField::side} * LampField::side, glm::vec4(0.0f));
  return !lamps.texels.empty();
}

std::optional<std::uint32_t> next_window_image(RendererState& state, const vulkan::FrameSlot& slot) {
  const Window* window = state.options.window;
  if (!window) return std::nullopt;
  if (state.swapchain.stale) {
    vkDeviceWaitIdle(state.device.device);
    renew_swapchain(state.swapchain, state.device, window->width(), window->height());
  }
  return acquire(state.swapchain, state.device, slot.image_acquired);
}

/// Creates images that only some frames need, at their first use.
void prepare_rare_targets(RendererState& state, PassContext& context, const Instant& instant,
                          const PreparedFrame& prepared) {
  const std::uint32_t width = state.targets.width, height = state.targets.height;
  const IceTargetSizes ice_sizes{layer_px(width), layer_px(height), instant.ice_surroundings_px,
                                 prepared.surroundings(), prepared.ice.beyond};
  if (!prepared.ice.list.empty() && !ice_targets_fit(state.ice_pass, ice_sizes)) {
    wait_for_frames(state.ring, state.device);
    prepare_ice_targets(state.ice_pass, context, ice_sizes);
  }
  if (prepared.road_mirror && !road_mirror_fits(state.road_mirror_pass, width, height)) {
    wait_for_frames(state.ring, state.device);
    prepare_road_mirror_targets(state.road_mirror_pass, state.memory, state.formats, width, height);
  }
  if (!instant.mirrors.empty() && !mirrors_fit(state.mirror_pass, instant.mirrors)) {
    wait_for_frames(state.ring, state.device);
    prepare_mirror_targets(state.mirror_pass, state.memory, state.formats, instant.mirrors);
  }
}

/// Adds sky, standing lamps and shadows: the light of every view.
void add_light(Frame& frame, bool new_sky, bool new_lamps) {
  RendererState& state = frame.state;
  const ResourceId table = frame.graph.add_image("sky table", state.sky_table, state.sky_table_access),
                   lamps = frame.graph.add_image("lamp field", state.lamp_image, state.lamps_access),
                   shadow_map =
                       frame.graph.add_image("shadow map", state.targets.shadow_map, state.targets.shadow_access);
  if (new_sky)
    frame.graph.add_pass("sky table", {{}, {{table, Access::transfer_destination}}}, [&frame] {
      const std::vector<std::uint64_t> texels = packed(*frame.instant.light);
      upload_texels(frame.context, frame.state.sky_table, std::as_bytes(std::span(texels)));
    });
  if (new_lamps)
    frame.graph.add_pass("lamp field", {{}, {{lamps, Access::transfer_destination}}}, [&frame] {
      const std::vector<std::uint64_t> texels = packed(frame.state.lamps);
      upload_texels(frame.context, frame.state.lamp_image, std::as_bytes(std::span(texels)));
    });
  frame.graph.add_pass("shadows", {{}, {{shadow_map, Access::depth_attachment}}}, [&frame] {
    for (std::size_t i = 0; i < cascade_count; ++i)
      draw_shadows(frame.state.shadow_pass, frame.context, frame.state.scene, frame.prepared.casters[i],
                   frame.prepared.shadows.cascades[i], frame.state.targets.shadow_map.layer_views[i]);
    mark_pass(frame.context, "shadows");
  });
  frame.view_reads = {{table, Access::sampled}, {shadow_map, Access::sampled}, {lamps, Access::sampled}};
}

void add_road_mirror(Frame& frame) {
  RoadMirrorPass& pass = frame.state.road_mirror_pass;
  const ResourceId image = frame.graph.add_image("road mirror", pass.image, pass.image_access),
                   depth = frame.graph.add_image("road mirror depth", pass.depth, pass.depth_access),
                   spread = frame.graph.add_image("road mirror, spread", pass.spread, pass.spread_access),
                   ripples = frame.graph.add_image("ripples", pass.ripples, pass.ripples_access);
  frame.graph.add_pass("ripples", {{}, {{ripples, Access::transfer_destination}}},
                       [&frame, &pass] { upload_ripples(pass, frame.context, frame.instant); });
  frame.graph.add_pass("road mirror",
                       {frame.view_reads, {{image, Access::color_attachment}, {depth, Access::depth_attachment}}},
                       [&frame, &pass] {
                         const PreparedRoadMirror& mirror = *frame.prepared.road_mirror;
                         draw_road_mirror(pass, frame.context, frame.state.scene, mirror, frame.instant.views.front(),
                                          view_bindings(frame.state),
                                          store(frame.context, std::span<const std::uint8_t>(frame.instant.soot.cover)),
                                          surface_light(frame.instant, mirror.lit_by_headlights, mirror.lit_by_lamps,
                                                        mirror.smoke_shade.buffer != VK_NULL_HANDLE));
                       });
  frame.graph.add_pass("road mirror, spread", {{{image, Access::sampled}}, {{spread, Access::color_attachment}}},
                       [&frame, &pass] {
                         spread_road_mirror(pass, frame.context, frame.instant.views.front());
                         mark_pass(frame.context, "road mirror");
                       });
  for (const ResourceId read : {image, depth, spread, ripples}) frame.view_reads.push_back({read, Access::sampled});
}

void add_mirrors(Frame& frame) {
  MirrorPass& pass = frame.state.mirror_pass;
  const ResourceId picture = frame.graph.add_image("mirrors", pass.picture, pass.picture_access),
                   samples = frame.graph.add_image("samples of mirrors", pass.samples, pass.samples_access),
                   depth = frame.graph.add_image("depth of mirrors", pass.depth, pass.depth_access);
  std::vector<ResourceUse> writes{{picture, Access::color_attachment}, {depth, Access::depth_attachment}};
  if (pass.multisampled()) writes.push_back({samples, Access::color_attachment});
  frame.graph.add_pass("mirrors", {frame.view_reads, writes}, [&frame] {
    draw_mirrors(frame.state, frame.context, frame.prepared, frame.instant);
    mark_pass(frame.context, "mirrors");
  });
  frame.view_reads.push_back({picture, Access::sampled});
}

void add_ice(Frame& frame) {
  ViewBindings bindings = view_bindings(frame.state);
  bindings.uniforms = frame.prepared.views.front().uniforms;
  const IceResources ice =
      add_ice_passes(frame.graph, frame.state.ice_pass, frame.context, frame.prepared, frame.instant,
                     {frame.view_reads, bindings, [&frame](std::uint32_t around) {
                        draw_surroundings(frame.state, frame.context,
                                          std::span(frame.prepared.around_views).subspan(6 * around, 6), frame.instant);
                      }});
  for (const ResourceUse& use : ice_reads(ice, frame.prepared)) frame.view_reads.push_back(use);
}

/// Adds the passes from the radiance of the views to the picture without its text.
void add_picture(Frame& frame, ResourceId radiance, ResourceId picture) {
  FrameTargets& targets = frame.state.targets;
  const bool smoothed = targets.smoothed();
  const ResourceId mapped =
      smoothed ? frame.graph.add_image("before smoothing", targets.mapped, targets.mapped_access) : picture;
  frame.graph.add_pass("tone mapping", {{{radiance, Access::sampled}}, {{mapped, Access::color_attachment}}},
                       [&frame, &targets] {
                         draw_tone_mapped(frame.state.tone_mapping_pass, frame.context, targets.radiance.view,
                                          targets.smoothed() ? targets.mapped.view : targets.picture.view,
                                          targets.width, targets.height, frame.instant.exposure.scale());
                         mark_pass(frame.context, "tone mapping");
                       });
  if (!smoothed) return;
  frame.graph.add_pass("smoothing", {{{mapped, Access::sampled}}, {{picture, Access::color_attachment}}},
                       [&frame, &targets] {
                         draw_smoothed(frame.state.smoothing_pass, frame.context, targets.mapped.view,
                                       targets.picture.view, targets.width, targets.height);
                         mark_pass(frame.context, "smoothing");
                       });
}

void add_overlay(Frame& frame, ResourceId picture, bool new_text, const std::vector<OverlayText>& passing) {
  RendererState& state = frame.state;
  const ResourceId atlas = frame.graph.add_image("text atlas", state.overlay_pass->atlas, state.atlas_access);
  if (new_text)
    frame.graph.add_pass("text atlas", {{}, {{atlas, Access::transfer_destination}}},
                         [&frame] { upload_atlas(*frame.state.overlay_pass, frame.context); });
  const auto add = [&](const std::vector<OverlayText>& texts, std::span<const light::QuadConstants> below) {
    if (texts.empty() && below.empty()) return;
    frame.graph.add_pass(
        "overlay",
        {{{atlas, Access::sampled}, {picture, Access::color_attachment}}, {{picture, Access::color_attachment}}},
        [&frame, texts = &texts, below] {
          const FrameTargets& targets = frame.state.targets;
          draw_overlay(*frame.state.overlay_pass, frame.context, below, *texts, targets.picture.view, targets.width,
                       targets.height);
          mark_pass(frame.context, "overlay");
        });
  };
  add(frame.instant.overlay, frame.housings);
  if (passing.empty()) return;
  const ResourceId kept =
      frame.graph.add_image("picture without passing texts", state.targets.kept, state.targets.kept_access);
  frame.graph.add_pass("kept picture", {{{picture, Access::transfer_source}}, {{kept, Access::transfer_destination}}},
                       [&frame] { keep_picture(frame.state.targets, frame.context); });
  frame.graph.keep(kept, Access::transfer_source);
  add(passing, {});
}

void add_present(Frame& frame, ResourceId picture, std::uint32_t window_image) {
  const ResourceId window = frame.graph.add_window(frame.state.swapchain.images[window_image]);
  frame.graph.add_pass("present", {{{picture, Access::transfer_source}}, {{window, Access::transfer_destination}}},
                       [&frame, window_image] {
                         record_copy(frame.context.slot.commands, frame.state.targets.picture, frame.state.swapchain,
                                     window_image);
                       });
  frame.graph.keep(window, Access::present);
}

}  // namespace

void draw_frame(RendererState& state, const Instant& instant, const std::vector<OverlayText>& passing) {
  RenderStatistics& statistics = state.statistics;
  statistics.triangles = statistics.shadow_triangles = statistics.draws = statistics.instances = 0;
  PassContext context{state.device,   state.memory,     state.layout,
                      state.samplers, state.formats,    begin_frame(state.ring, state.device),
                      statistics,     state.refinements};
  statistics.pass_times = begin_pass_marks(context.slot.marks, state.device, context.slot.commands);

  const bool new_sky = state.table_light != instant.light;
  state.table_light = instant.light;
  state.exposure = instant.exposure;
  const bool new_lamps = renew_lamps(state, world_eye(instant.views.front()));
  FrameTargets& targets = state.targets;
  const SeenFrame seen = seen_frame(instant, state.scene.whole_revision);
  const glm::vec2 offset_px = state.temporal_pass.present() ? begin_frame(state.temporal_pass, seen) : glm::vec2(0.0f);
  Frame frame{state,
              context,
              instant,
              prepare_frame(context, state.scene, instant, state.lamps, targets.width, targets.height, offset_px),
              inset_housings(instant, targets.width, targets.height),
              {},
              {}};
  std::vector<OverlayText> texts = instant.overlay;
  texts.insert(texts.end(), passing.begin(), passing.end());
  const bool new_text = lay_out(*state.overlay_pass, texts, !frame.housings.empty());
  targets.is_kept = !passing.empty();
  if (targets.is_kept && targets.kept.image == VK_NULL_HANDLE) create_kept_target(targets, state.memory);
  prepare_rare_targets(state, context, instant, frame.prepared);

  const ResourceId radiance = frame.graph.add_image("radiance", targets.radiance, targets.radiance_access),
                   depth = frame.graph.add_image("depth", targets.depth, targets.depth_access),
                   picture = frame.graph.add_image("picture", targets.picture, targets.picture_access);
  add_light(frame, new_sky, new_lamps);
  if (frame.prepared.road_mirror) add_road_mirror(frame);
  if (!frame.prepared.mirror_views.empty()) add_mirrors(frame);
  if (!frame.prepared.ice.list.empty()) add_ice(frame);
  frame.graph.add_pass("views",
                       {frame.view_reads, {{radiance, Access::color_attachment}, {depth, Access::depth_attachment}}},
                       [&frame] { draw_views(frame.state, frame.context, frame.prepared, frame.instant); });
  if (state.temporal_pass.present())
    add_temporal_passes(frame.graph, state.temporal_pass, context, targets, radiance, depth, seen,
                        instant.exposure.scale());
  if (state.bloom_pass.present()) add_bloom_passes(frame.graph, state.bloom_pass, context, radiance, targets.radiance);
  add_picture(frame, radiance, picture);
  add_overlay(frame, picture, new_text, passing);
  frame.graph.keep(picture, Access::transfer_source);
  const std::optional<std::uint32_t> window_image = next_window_image(state, context.slot);
  if (window_image) add_present(frame, picture, *window_image);

  frame.graph.record(context.slot.commands);
  state.lamps.texels.clear();
  if (window_image) {
    submit(state.ring, context.slot, state.device,
           {context.slot.image_acquired, state.swapchain.finished[*window_image]});
    present(state.swapchain, state.device, *window_image);
  } else {
    submit(state.ring, context.slot, state.device);
  }
  state.drawn = true;
  if (state.device.validation_log) {
    statistics.validation_messages = state.device.validation_log->messages;
    const std::lock_guard lock(state.device.validation_log->mutex);
    statistics.first_validation_message = state.device.validation_log->first;
  }
}

}  // namespace septet::render

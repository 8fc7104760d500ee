#include "engine/render/view_drawing.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>

namespace septet::render {

ViewBindings view_bindings(const RendererState& state) {
  return {{}, state.sky_table.view, state.targets.shadow_map.view, state.noise.view, state.lamp_image.view};
}

SurfaceLight surface_light(const Instant& instant, bool lit_by_headlights, bool lit_by_lamps, bool smoke_shaded) {
  return {instant.environment.road_wetness > 0.0,
          lit_by_headlights,
          lit_by_lamps,
          !casts_shadows(*instant.light),
          instant.environment.snow_cover > 0.0,
          !instant.soot.cover.empty(),
          std::ranges::any_of(instant.headlights, [](const Headlight& light) { return light.main_beam > 0.0f; }),
          !instant.beacons.empty(),
          smoke_shaded};
}

namespace {

void draw_view(RendererState& state, PassContext& context, const PreparedView& prepared, const Instant& instant,
               const FrameData& soot, const std::function<void()>& draw_seen_through,
               const PreparedGlass& mirrors = {}) {
  const Environment& environment = instant.environment;
  set_viewport(context, prepared.view->viewport);
  vkCmdSetFrontFace(context.slot.commands,
                    prepared.view->mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
  ViewBindings bindings = view_bindings(state);
  bindings.uniforms = prepared.uniforms;
  bindings.light_clusters = prepared.light_clusters;
  bindings.smoke_shade = prepared.smoke_shade;
  if (prepared.mirrored_by_road) {
    bindings.road_mirror = state.road_mirror_pass.image.view;
    bindings.road_mirror_spread = state.road_mirror_pass.spread.view;
    bindings.road_mirror_depth = state.road_mirror_pass.depth.view;
    bindings.ripples = state.road_mirror_pass.ripples.view;
  }
  push_view(context, bindings);
  bind_instances(context, prepared.draws.records);
  const SurfaceLight light =
      surface_light(instant, prepared.lit_by_headlights, prepared.lit_by_lamps, prepared.smoke_shaded());
  push_records(context, soot);
  draw_surfaces(state.surface_pass, context, state.scene, prepared.draws, SurfaceKind::opaque, light);
  if (mirrors.count > 0) {
    draw_mirror_glass(state.mirror_pass, context, mirrors);
    push_records(context, soot);
  }
  mark_pass(context, "opaque");
  draw_surfaces(state.surface_pass, context, state.scene, prepared.draws, SurfaceKind::cut, light);
  mark_pass(context, "cut-outs");
  draw_surfaces(state.surface_pass, context, state.scene, prepared.draws, SurfaceKind::stripe, light);
  mark_pass(context, "stripes");
  if (prepared.contact_count > 0) {
    draw_contacts(state.contact_pass, context, prepared.contacts, prepared.contact_count);
    push_records(context, soot);
  }
  mark_pass(context, "contact shadows");
  draw_sky(state.sky_pass, context, environment.cloud_cover > 0.0, instant.light->night > 0.0f);
  mark_pass(context, "sky");
  draw_seen_through();
  mark_pass(context, "ice and glass");
  draw_surfaces(state.surface_pass, context, state.scene, prepared.draws, SurfaceKind::blended, light);
  mark_pass(context, "blended");
  draw_wet_lamps(state.glow_pass, context, prepared.wet_lamps, prepared.wet_lamp_count);
  mark_pass(context, "wet lamps");
  draw_smoke(state.smoke_pass, context, prepared.smoke, prepared.puff_count);
  mark_pass(context, "smoke");
  draw_glows(state.glow_pass, context, prepared.glows, prepared.glow_count);
  mark_pass(context, "glows");
  draw_precipitation(state.precipitation_pass, context, prepared.streaks, prepared.streak_count);
  mark_pass(context, "precipitation");
}

}  // namespace

void draw_views(RendererState& state, PassContext& context, const PreparedFrame& frame, const Instant& instant) {
  const FrameData soot = store(context, std::span<const std::uint8_t>(instant.soot.cover));
  begin_view_rendering(context, state.targets.radiance, state.targets.depth);
  for (std::uint32_t i = 0; i < frame.views.size(); ++i) {
    const PreparedView& prepared = frame.views[i];
    if (i > 0) clear_inset(context, state.targets, *prepared.view);
    const Vec3 eye_m = world_eye(*prepared.view);
    draw_view(
        state, context, prepared, instant, soot,
        [&] {
          if (frame.ice.list.empty() && instant.glass.empty()) return;
          if (!frame.ice.list.empty()) draw_ice(state.ice_pass, context, frame.ice, i, instant.ice, frame.ice_upload);
          draw_glass(state.ice_pass, context, instant.glass, frame.glass, eye_m, false);
          // Ice binds no instances and pushes its own constants; the passes after it need both.
          bind_instances(context, prepared.draws.records);
        },
        i == 0 ? frame.mirrors : PreparedGlass{});
    draw_glass(state.ice_pass, context, instant.glass, frame.glass, eye_m, true);
  }
  vkCmdEndRendering(context.slot.commands);
}

void draw_surroundings(RendererState& state, PassContext& context, std::span<const PreparedView> views,
                       const Instant& instant) {
  const FrameData soot = store(context, std::span<const std::uint8_t>(instant.soot.cover));
  begin_view_rendering(context, state.ice_pass.targets[IceImage::around],
                       state.ice_pass.targets[IceImage::around_depth]);
  for (const PreparedView& prepared : views) draw_view(state, context, prepared, instant, soot, [] {});
  vkCmdEndRendering(context.slot.commands);
}

void draw_mirrors(RendererState& state, PassContext& context, const PreparedFrame& frame, const Instant& instant) {
  const FrameData soot = store(context, std::span<const std::uint8_t>(instant.soot.cover));
  begin_mirror_rendering(state.mirror_pass, context, instant.mirrors);
  for (const PreparedView& prepared : frame.mirror_views) draw_view(state, context, prepared, instant, soot, [] {});
  vkCmdEndRendering(context.slot.commands);
}

}  // namespace septet::render

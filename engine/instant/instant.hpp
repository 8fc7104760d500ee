#pragma once
/// One description of an instant, as every renderer draws it: what stands where, what shines, the light, the views.
///
/// `describe` makes it from a frame's input (what a snapshot shows: sim-client/frame) and the scene; from there on it is const.
/// Together with the scene's meshes, materials, images and placed instances (scene::ResolvedScene) it is all that a picture
/// depends on: no renderer asks a snapshot, a clock or a file. The rasteriser (engine/render) draws it, and so does the ray
/// tracer (engine/raytrace).
///
/// World frame: metres, double; x east, y north, z up. Colours: linear Rec. 709. Radiance in units of 8000 cd/m², irradiance in
/// units of 8000 lx, lamps' intensity in units of 8000 cd (luminance_unit_cdpm2 in atmosphere.hpp), so that half floats
/// hold all from starlight to the sun's disc. Radiance · exposure.scale() is what the tone curve takes.
///
/// A renderer adds, for what it sees: the scene's instances while the eye's distance is in their range; `parts`, `loose`, `ice`; the
/// sky (`sky_radiance`), the sun's or moon's disc toward light->light_direction; `smoke` by Beer and Lambert; `soot` on
/// surfaces; water on wet roads (wet_road.hpp); what falls (environment.rain_mm_per_h) before an eye in the open; headlights by their beam; air
/// that takes `extinction_per_m` of light and is as bright as the sky behind it, below the horizon as the sky just above it, and under a roof as
/// the lamps there light it (light::roofed_haze).

#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "engine/instant/atmosphere.hpp"
#include "engine/instant/exposure.hpp"
#include "engine/instant/frame_input.hpp"
#include "engine/instant/participants.hpp"
#include "engine/instant/scene_summary.hpp"
#include "engine/instant/wet_road.hpp"

namespace septet::instant {

/// Triangles of this instant alone, with what their prototype and their place say.
struct LooseMesh {
  DynamicMesh mesh;
  std::uint32_t material = 0;  ///< Indexes ResolvedScene::materials.
  float share_of_sky = 1.0f;
};

struct Instant {
  double simulated_time_s = 0.0;
  Environment environment;                ///< Weather: wetness, snow, rain, cloud cover, wind.
  std::shared_ptr<const SkyLight> light;  ///< Sun, moon and sky; never null. Instants of one weather share it.
  Exposure exposure;
  /// Of their emission with which materials are seen: an eye that has adapted to the dark glares less than it says.
  float emission_share = 1.0f;
  float extinction_per_m = 0.0f;     ///< Of the air: fog and, where the first view's eye sees the sky, what falls.
  float share_of_sky = 1.0f;         ///< Where the first view's eye is: no rain falls under a roof.
  std::optional<RoadPlane> road;     ///< Near the first view's eye: what a wet road mirrors in.
  std::vector<FrameView> views;      ///< At least one.
  std::vector<MirrorGlass> mirrors;  ///< Seen in the first view.
  std::vector<PlacedMesh> parts;     ///< Of participants, ordered by mesh.
  std::vector<std::shared_ptr<const ReshapedParts>> reshaped;  ///< What `parts` have in their meshes' stead.
  std::vector<LooseMesh> loose;
  std::vector<ice::IceBody> ice;    ///< None without vertices.
  std::vector<ice::IceBody> glass;  ///< Likewise.
  std::uint32_t ice_surroundings_px = 64;
  bool ice_surroundings_kept = false;
  std::vector<LampGlow> lamps;  ///< That shine and are seen, for the glow around them.
  /// As strong as they look beside the light around them: by day as they are, at night and under roofs as many times stronger as the
  /// exposure there is less than a camera's. None whose pool cannot be seen.
  std::vector<Headlight> headlights;
  /// As strong as they look beside the light around them. None whose light cannot be seen at three metres.
  std::vector<BeaconLight> beacons;
  std::vector<GroundContact> contacts;  ///< Of participants, for renderers that do not find out by rays.
  std::vector<SmokePuff> smoke;         ///< Of fires, and the spray behind wheels.
  SootField soot;
  std::vector<OverlayText> overlay;  ///< Over the finished picture.
};

/// `light`: that of the input's environment, if it is at hand (sky_light takes milliseconds). The input has a view (checked).
Instant describe(FrameInput input, const SceneSummary& scene, std::shared_ptr<const SkyLight> light = nullptr);

}  // namespace septet::instant

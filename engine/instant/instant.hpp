#pragma once
/// Description of an instant, as every renderer draws it: placed meshes, lamps, light, views.
///
/// `describe` makes it from a frame's input (content of a snapshot: sim-client/frame) and the scene; from there on it
/// is const. Together with the scene's meshes, materials, images and placed instances (scene::ResolvedScene) it
/// determines a picture completely: no renderer reads a snapshot, a clock or a file. The rasteriser (engine/render)
/// draws it, and so does the ray tracer (engine/raytrace).
///
/// World frame: metres, double; x east, y north, z up. Colours: linear Rec. 709. Radiance in units of 8000 cd/m²,
/// irradiance in units of 8000 lx, lamps' intensity in units of 8000 cd (luminance_unit_cdpm2 in atmosphere.hpp), so
/// that half floats hold everything from starlight to the sun's disc. Radiance · exposure.scale() is the input of the
/// tone curve.
///
/// A renderer draws: the scene's instances while the eye's distance is in their range; `parts`, `loose`, `ice`; the sky
/// (`sky_radiance`), the sun's or moon's disc toward light->light_direction; `smoke` by Beer and Lambert; `soot` on
/// surfaces; water on wet roads (wet_road.hpp); precipitation (environment.rain_mm_per_h) before an eye in the open;
/// headlights by their beam; air that attenuates light by `extinction_per_m` and has the radiance of the sky behind it,
/// below the horizon that of the sky just above it, and under a roof that given by the lamps there
/// (light::roofed_haze).

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

/// Triangles of this instant alone, with the material of their prototype and the sky at their place.
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
  /// Factor on the emission of materials as seen: an eye adapted to the dark is dazzled less than it states.
  float emission_share = 1.0f;
  /// Extinction of the air: fog and, if the first view's eye sees the sky, precipitation.
  float extinction_per_m = 0.0f;
  float share_of_sky = 1.0f;         ///< Share of the sky at the first view's eye: no rain falls under a roof.
  std::optional<RoadPlane> road;     ///< Plane near the first view's eye in which a wet road mirrors.
  std::vector<FrameView> views;      ///< One or more.
  std::vector<MirrorGlass> mirrors;  ///< Mirrors in the first view.
  std::vector<PlacedMesh> parts;     ///< Parts of participants, ordered by mesh.
  std::vector<std::shared_ptr<const ReshapedParts>> reshaped;  ///< Owners of the meshes that replace those of `parts`.
  std::vector<LooseMesh> loose;
  std::vector<ice::IceBody> ice;    ///< Bodies with vertices.
  std::vector<ice::IceBody> glass;  ///< Bodies with vertices.
  std::uint32_t ice_surroundings_px = 64;
  bool ice_surroundings_kept = false;
  std::vector<LampGlow> lamps;  ///< Lit lamps in view, for the glow around them.
  /// Headlights as strong as they appear relative to the light around them: by day unchanged, at night and under roofs
  /// stronger by the ratio of a camera's exposure to the one there. Headlights whose pool is invisible are left out.
  std::vector<Headlight> headlights;
  /// Beacons as strong as they appear relative to the light around them. Those whose light is invisible at three metres
  /// are left out.
  std::vector<BeaconLight> beacons;
  std::vector<GroundContact> contacts;  ///< Contacts of participants, for renderers that do not find them by rays.
  std::vector<SmokePuff> smoke;         ///< Puffs of fires, and of the spray behind wheels.
  SootField soot;
  std::vector<OverlayText> overlay;  ///< Text over the finished picture.
};

/// Describes an instant. `light`: that of the input's environment, if it is at hand (sky_light takes milliseconds). The
/// input has a view (checked).
Instant describe(FrameInput input, const SceneSummary& scene, std::shared_ptr<const SkyLight> light = nullptr);

}  // namespace septet::instant

#pragma once
/// Draws meshes with their materials: opaque, with holes, transparent, and thin stripes.

#include <map>

#include "engine/render/passes/surface_draws.hpp"

namespace septet::render {

/// Stripes lie on opaque surfaces and cover shares of pixels.
enum class SurfaceKind : std::uint8_t { opaque, cut, blended, stripe };

struct SurfacePass {
  std::map<std::uint32_t, VkPipeline> pipelines;  ///< Indexed by variant; created at first use.
};

void destroy_surface_pass(SurfacePass& pass, const vulkan::Device& device);

/// Weather and light that shaders are specialised for.
struct SurfaceLight {
  bool wet = false;                                 ///< Wettable materials reflect.
  bool headlights = false, standing_lamps = false;  ///< Light from headlights, from standing lamps.
  bool unshaded = false;                            ///< True if no shadow of the sun or moon is visible.
  bool snowy = false;
  bool sooty = false;           ///< FrameInput::soot is bound.
  bool main_beams = false;      ///< Main beam of some headlights is on.
  bool beacons = false;         ///< Light from beacons.
  bool smoke_shaded = false;    ///< Smoke lies before the sun or moon.
  bool mirror_of_road = false;  ///< Drawn for a wet road's mirror image, with an alpha of its own.

  /// Bits of `lamps` in shaders/surface.frag.
  std::uint32_t lamps() const {
    return std::uint32_t{headlights} | std::uint32_t{standing_lamps} << 1 |
           std::uint32_t{headlights && main_beams} << 2 | std::uint32_t{beacons} << 3;
  }
};

/// Draws the parts of one kind, in the list's order (blended: in reverse, so farthest first).
void draw_surfaces(SurfacePass& pass, PassContext& context, const DeviceScene& scene, const SurfaceDraws& draws,
                   SurfaceKind kind, const SurfaceLight& light);

}  // namespace septet::render

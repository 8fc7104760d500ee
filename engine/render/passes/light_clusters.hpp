#pragma once
/// Lists of headlights by place: squares on the ground around the eye, each with a list of the lamps whose beams reach
/// it, so that a pixel reads only those. For graphics cards, where more headlights light the view than the nearest ten
/// (most_headlights).
///
/// After Olsson, Billeter and Assarsson, "Clustered Deferred and Forward Shading" (2012). Deviation: squares seen from
/// above instead of blocks of the view frustum, since headlights light places along roads; so one table serves all
/// directions of view.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/instant/participants.hpp"
#include "engine/render/passes/pass_context.hpp"
#include "engine/render/words.hpp"

namespace septet::render {

struct LightClusters {
  static constexpr std::uint32_t side = 24;  ///< Squares along x and along y; the eye is in the middle.
  static constexpr float square_m = 20.0f;
  static constexpr std::size_t most_lights = 64;     ///< Nearest lights.
  static constexpr float least_irradiance = 3e-6f;   ///< Lower bound: weaker light on a square is left out (0.024 lx).
  static constexpr std::uint32_t words_a_light = 8;  ///< Place relative to the eye, intensity, direction, main beam.

  /// Table as shaders/surface.frag reads it: index of the start of each square's list, by rows to the north, and of the
  /// end of the last one; the lights as floats; the lists. Indices count from the first word.
  std::vector<std::uint32_t> words;
};

LightClusters light_clusters(const Vec3& eye_m, std::span<const Headlight> headlights);
/// Uploads the clusters; returns an empty FrameData without clustered headlights, or without headlights.
FrameData store_light_clusters(PassContext& context, const Vec3& eye_m, std::span<const Headlight> headlights);

}  // namespace septet::render

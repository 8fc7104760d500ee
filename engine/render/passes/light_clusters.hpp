#pragma once
/// Which headlights light which place: squares on the level around the eye, each with a list of those whose beams reach it, so that a pixel asks
/// those alone. For graphics cards, where more than the nearest eight light what is seen.
///
/// After Olsson, Billeter and Assarsson, "Clustered Deferred and Forward Shading" (2012). Deviation: squares seen from above instead of blocks of
/// the view, since what headlights light lies along roads; so one table serves a view whichever way it looks.

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
  static constexpr std::size_t most_lights = 64;     ///< The nearest.
  static constexpr float least_irradiance = 3e-6f;   ///< What lights a place less is left out: 0.024 lx.
  static constexpr std::uint32_t words_a_light = 8;  ///< Place relative to the eye, intensity, direction, main beam.

  /// As shaders/surface.frag reads it: where each square's list begins, by rows to the north, and where the last one ends; the lights as
  /// floats; the lists. Places are counted from the first word.
  std::vector<std::uint32_t> words;
};

LightClusters light_clusters(const Vec3& eye_m, std::span<const Headlight> headlights);
/// On the device; nothing where they are not asked for.
FrameData store_light_clusters(PassContext& context, const Vec3& eye_m, std::span<const Headlight> headlights);

}  // namespace septet::render

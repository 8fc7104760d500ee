#pragma once
/// One body of ice for a renderer: its surface, its inside, and its appearance. Plain data.

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/light/ice_optics.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/world/ice_vertex.hpp"

namespace septet::ice {

enum class Mode : std::uint8_t {
  paper,    ///< Equations 1 to 4: one lookup for both faces.
  quality,  ///< Rays are followed from face to face: two interfaces, total reflection, absorption.
};

/// Drawn quantity: the picture, or the depth of a layer between its nearest (white) and its furthest place (figure 5 a,
/// b).
enum class Shown : std::uint8_t { all, front_depth, back_depth };

/// Layer on glass: a surface without thickness, seen from both sides, through which the background is seen (glass.hpp).
enum class OnGlass : std::uint8_t { nothing, frost, cracks };

/// Sign of the back face's normal in equation 1 (engine/light/ice_optics.hpp): as the paper prints it, or as a lens
/// bends light.
enum class BackSign : std::int8_t { as_printed = -1, as_a_lens = 1 };

struct Look {
  OnGlass on_glass = OnGlass::nothing;
  Mode mode = Mode::paper;
  Shown shown = Shown::all;
  bool two_sided = true;  ///< Off: the front face alone refracts.
  BackSign back_sign = BackSign::as_printed;
  float back_share = light::paper_back_share;
  bool reflects = true;        ///< Off: refraction alone.
  bool bent_by_cracks = true;  ///< In quality mode: cracks turn the light that leaves through the back face.
  /// In quality mode: light that has left continues through further ice of equal absorption.
  bool seen_beyond = false;
  bool thin = false;  ///< Light goes straight through: the background is seen in its place, under the reflection alone.
  float bump = 0.12f;         ///< Slope of the unevenness; 0: as smooth as its mesh.
  float bump_size_m = 0.05f;  ///< Length of its longest waves.
  float roughness = 0.0f;     ///< Share of the surface whitened by crystals of frost.
  float wetness = 0.0f;       ///< 1: a film of water lies over bumps and crystals, and its reflection is sharp.
  float share_of_sky = 1.0f;  ///< Share of the sun's light that reaches it.
  glm::vec3 absorption_per_m = light::clear_ice_absorption_per_m;
};

struct IceBody {
  Vec3 origin_m{0.0};               ///< World.
  std::vector<IceVertex> vertices;  ///< Relative to the origin along the world's axes; three a triangle, ccw in front.
  std::vector<IceVertex> inside;    ///< Cracks and planes of air, seen from both sides, reaching beyond the surface.
  Look look;
};

}  // namespace septet::ice

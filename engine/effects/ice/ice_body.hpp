#pragma once
/// One body of ice as a renderer draws it: its surface, what is inside it, and how it looks. Plain data.

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/light/ice_optics.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::ice {

enum class Mode : std::uint8_t {
  paper,    ///< Equations 1 to 4: one lookup for both faces.
  quality,  ///< Light is followed from face to face: two interfaces, total reflection, absorption.
};

/// What is drawn of it: all, or the depth of a layer between its nearest (white) and its furthest place (figure 5 a, b).
enum class Shown : std::uint8_t { all, front_depth, back_depth };

/// What lies on glass: a surface without thickness, seen from both sides, of which what lies behind is seen through (glass.hpp).
enum class OnGlass : std::uint8_t { nothing, frost, cracks };

/// How the back face's normal enters equation 1 (engine/light/ice_optics.hpp): as the paper prints it, or as a lens bends light.
enum class BackSign : std::int8_t { as_printed = -1, as_a_lens = 1 };

struct Look {
  OnGlass on_glass = OnGlass::nothing;
  Mode mode = Mode::paper;
  Shown shown = Shown::all;
  bool two_sided = true;  ///< Off: the front face alone refracts.
  BackSign back_sign = BackSign::as_printed;
  float back_share = light::paper_back_share;
  bool reflects = true;        ///< Off: what is seen through it alone.
  bool bent_by_cracks = true;  ///< In quality mode: cracks turn the light that leaves through the back face.
  bool seen_beyond =
      false;  ///< In quality mode: light that has left goes on through what else of ice it meets, of equal absorption.
  bool thin =
      false;  ///< Light goes straight through: what lies behind is seen in its place, and only what is mirrored lies over it.
  float bump = 0.12f;         ///< Slope of the unevenness; 0: as smooth as its mesh.
  float bump_size_m = 0.05f;  ///< Length of its longest waves.
  float roughness = 0.0f;     ///< Share of the surface that crystals of frost make white.
  float wetness = 0.0f;       ///< 1: a film of water lies over bumps and crystals, and what it mirrors is sharp.
  float share_of_sky = 1.0f;  ///< Of the sun's light that reaches it.
  glm::vec3 absorption_per_m = light::clear_ice_absorption_per_m;
};

/// Of a body's surface; `rest_m`: where the point lay in the whole body before anything moved or broke, which is what
/// unevenness, cracks and air keep to. Of what is inside (cracks.hpp): texture coordinates, and which kind it is.
struct IceVertex {
  glm::vec3 position_m{0.0f};
  glm::vec3 normal{0.0f};
  glm::vec3 rest_m{0.0f};
};

struct IceBody {
  Vec3 origin_m{0.0};               ///< World.
  std::vector<IceVertex> vertices;  ///< From the origin along the world's axes; three a triangle, ccw in front.
  std::vector<IceVertex> inside;    ///< Cracks and planes of air, seen from both sides, reaching beyond the surface.
  Look look;
};

}  // namespace septet::ice

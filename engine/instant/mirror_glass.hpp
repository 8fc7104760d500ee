#pragma once
/// A mirror of the car in its place before the eyes, by the law of reflection at every point of its glass.
///
/// The glass is a part of a plane, or of a sphere that bulges towards the eye. From the eye E a ray meets it at P, where its normal is n, and
/// leaves along d = i − 2 (i·n) n, with i = (P − E)/|P − E|. What is seen there is found in a picture taken from one point behind the glass:
/// the one nearest to all those rays run backwards (least squares). A flat glass sends them all through it: it is the eye's image. Of a convex
/// one they miss it a little (its image of a point is none): on a screen of 1920 pixels across 60° things from 4 m on are within 1.5 pixels
/// of where the law has them (tested). Each corner of the glass's triangles knows its place in that picture.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/instant/view.hpp"

namespace septet::instant {

struct MirrorGlass {
  struct Corner {
    Vec3 position_m{0.0};  ///< Car frame.
    glm::vec2 at{0.0f};    ///< In the picture: 0 to 1 of its viewport from the upper left.
  };
  FrameView picture;            ///< What is seen in it. Its viewport: of the picture that holds those of all mirrors.
  std::vector<Corner> corners;  ///< Three a triangle, ccw in front.
  float reflectance = 0.9f;     ///< Of silvered glass. UN Regulation 46: at least 0.4, dipped at least 0.04.
  bool wholly_seen = false;     ///< No part of it lies beside the view.
};

/// The outline of a glass `half_m` wide and high, its corners rounded, around its middle; `share` 1 is its rim. Car mirrors' are about so.
glm::dvec2 glass_outline(const glm::dvec2& half_m, double angle_rad, double share = 1.0);

/// `glass`: its corners as the eye sees them; `radius_m` of its curvature, 0: flat. `through` is the view that it is seen in, `size` its
/// size in pixels: the picture has about as many as the glass has there, and lies at (0, 0). Nothing where the view does not see it, from
/// behind too.
std::optional<MirrorGlass> mirror_glass(const ScreenCorners& glass, double radius_m, const OffAxisView& through,
                                        const PixelRectangle& size);

}  // namespace septet::instant

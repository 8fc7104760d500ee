#pragma once
/// Mirror of the car at its place before the eyes, by the law of reflection at every point of its glass.
///
/// The glass is a part of a plane, or of a sphere that bulges towards the eye. From the eye E a ray meets it at P, with
/// normal n, and leaves along d = i − 2 (i·n) n, with i = (P − E)/|P − E|. The reflected light is looked up in a
/// picture taken from one point behind the glass: the point nearest to all those rays run backwards (least squares).
/// For a flat glass all rays pass through it: it is the eye's image. For a convex glass they miss it a little, since
/// the image of a point is not a point: on a screen of 1920 pixels across 60° objects from 4 m on are within 1.5 pixels
/// of their place by the law (tested). Each corner of the glass's triangles has its place in that picture.

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
    glm::vec2 at{0.0f};    ///< Place in the picture: 0 to 1 of its viewport from the upper left.
  };
  FrameView picture;  ///< View in the mirror. Its viewport lies in the picture that holds those of all mirrors.
  std::vector<Corner> corners;  ///< Three a triangle, ccw in front.
  float reflectance = 0.9f;  ///< Reflectance of silvered glass. UN Regulation 46: at least 0.4, dipped at least 0.04.
  bool wholly_seen = false;  ///< True if no part of it lies outside the view.
};

/// Point of the outline of a glass `half_m` wide and high, its corners rounded, around its middle; `share` 1 is its
/// rim. Car mirrors have about this form.
glm::dvec2 glass_outline(const glm::dvec2& half_m, double angle_rad, double share = 1.0);

/// Mirror in a view. `glass`: its corners as the eye sees them; `radius_m` of its curvature, 0: flat; `through`: the
/// view that it is seen in; `size`: size of that view in pixels. The picture has about as many pixels as the glass
/// covers in the view, and lies at (0, 0). Empty if the view does not see the glass, also from behind.
std::optional<MirrorGlass> mirror_glass(const ScreenCorners& glass, double radius_m, const OffAxisView& through,
                                        const PixelRectangle& size);

}  // namespace septet::instant

#pragma once
/// View in a mirror: through its glass, from the place of the eye's image behind it.
///
/// A flat glass images the eye as far behind it as the eye is before it, and a ray from there through a point of the
/// glass is the one that the law of reflection gives. A convex one of radius R (focal length f = R/2) images the eye,
/// at the distance d from the glass's plane, at f·d/(d + f) behind it, and at the same share f/(d + f) of its offset
/// from the glass's middle (paraxial optics: exact at the middle, where the law of reflection holds too; towards the
/// edges of a car's mirror it errs by a few degrees).

#include "engine/instant/off_axis_view.hpp"

namespace septet::instant {

/// Projection of a mirror. `glass`: its corners as the driver sees them. The picture has left and right of the scene
/// behind the car; the mirror shows it flipped left to right (FrameView::mirrored). Objects before the glass are not
/// drawn. `radius_m`: 0 for a flat glass. Refuses an eye on or behind the glass, and corners that do not form a
/// rectangle.
Expected<OffAxisView> mirror_view(const ScreenCorners& glass, const Vec3& eye_m, double radius_m = 0.0);

}  // namespace septet::instant

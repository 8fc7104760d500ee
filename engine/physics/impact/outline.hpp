#pragma once
/// Outlines in plan, and where two of them touch.
///
/// Every outline is a rectangle with rounded corners: a car, a carton (half_m, round_m), a post or a trunk (a rectangle
/// that is all corner), a stretch of a wall (as wide as its two roundings). So one function serves box against box,
/// post and wall. World frame, metres. A rectangle must be rounded by a millimetre at least, for a normal at a
/// corner is the direction to what is near it.

#include <optional>

#include "engine/physics/impact/impulse.hpp"

namespace septet::impact {

struct Outline {
  Vec2 centre_m{0.0};
  Vec2 forward{1.0, 0.0};  ///< Unit length.
  Vec2 half_m{0.0};        ///< Half length along `forward`, half width.
  double round_m = 0.0;    ///< Radius of the corners, at most the lesser half.
};

/// `round_m` is cut to what the rectangle bears.
Outline box_outline(const Vec2& centre_m, const Vec2& forward, const Vec2& half_m, double round_m);
Outline post_outline(const Vec2& centre_m, double radius_m);
/// `radius_m`: half the thickness.
Outline wall_outline(const Vec2& from_m, const Vec2& to_m, double radius_m);

/// The outlines as they lie: the nearest two surfaces, or the deepest.
struct Meeting {
  Place place;         ///< Between the two surfaces; of sides that lie along each other, at any point of them.
  double gap_m = 0.0;  ///< Along the normal; negative: they overlap.
};
Meeting nearest(const Outline& first, const Outline& second);

/// The outlines' contact, where they overlap: `nearest`, in the middle of the stretch on which they do.
std::optional<Meeting> contact_of(const Outline& first, const Outline& second);

/// Middle of the stretch along the tangent on which the two meet once each has sunk into the other by `depth_m` along
/// the normal: where the crush carries, as against the corner that touched first. On the tangent through the place.
Vec2 engaged_point_m(const Outline& first, const Outline& second, const Place& place, double depth_m);

/// Depth of the crush in which the outlines, moving along `way`, are past each other. Seen along it they overlap by P,
/// and the narrower is W wide: P where that is a scrape, without bound where the narrower is covered wholly,
/// P W/(W − P) between. 0 where they pass.
double passing_depth_m(const Outline& first, const Outline& second, const Vec2& way);

}  // namespace septet::impact

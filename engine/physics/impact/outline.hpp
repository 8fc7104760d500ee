#pragma once
/// Outlines in plan, and where two of them touch.
///
/// Every outline is a rectangle with rounded corners: a car, a carton (half_m, round_m), a post or a trunk (a rectangle
/// that is all corner), a stretch of a wall (as wide as its two roundings). So one function serves box against box,
/// post and wall. World frame, metres. A rectangle must be rounded by a millimetre at least, for a normal at a
/// corner is the direction to what is near it.
///
/// A crushed outline has lost what lay beyond straight cuts: a wall leaves its own line in a hull, turned as the hull
/// was when it was crushed, and what lies behind that line is as it was. A trunk's notch is taken for a cut, too.

#include <array>
#include <cstddef>
#include <optional>

#include "engine/physics/impact/impulse.hpp"

namespace septet::impact {

/// In the outline's own axes, from its centre: nothing is left where way · p > offset_m.
struct Cut {
  Vec2 way{1.0, 0.0};  ///< Unit length, outwards.
  double offset_m = 0.0;
};
struct Cuts {
  std::array<Cut, 6> each{};
  std::size_t count = 0;
};

struct Outline {
  Vec2 centre_m{0.0};
  Vec2 forward{1.0, 0.0};  ///< Unit length.
  Vec2 half_m{0.0};        ///< Half length along `forward`, half width.
  double round_m = 0.0;    ///< Radius of the corners, at most the lesser half.
  Cuts cuts{};
  /// Unit length, or 0. A thin wall is met from the side to which this points, within 60 degrees, however deep a hull
  /// lies in it, and nothing passes it by.
  Vec2 front{0.0};
};

/// Distance from the outline's centre to its farthest part along `way`, of unit length.
double reach_m(const Outline& outline, const Vec2& way);

/// The same from `from_m`, of the part that lies beside a line from there along `along` (unit length), `length_m` long;
/// −infinity where no part does.
double reach_beside_m(const Outline& outline, const Vec2& way, const Vec2& from_m, const Vec2& along, double length_m);

/// Cuts the outline so that it reaches less far along `way` by `depth_m`; two centimetres of it are always left. Of
/// ways nearly the same, and of more ways than there is room for, the nearest one's cut is moved on.
void cut_off(const Vec2& way, double depth_m, Outline& outline);

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

/// How the outlines, moving along a way, are past each other. Seen along it they overlap by P, and the narrower is W
/// wide: after a crush of P where that is a scrape, never where the narrower is covered wholly, after P W/(W − P)
/// between. Depth 0 where they pass.
struct Passing {
  double depth_m = INFINITY;
  double aside_m = 0.0;     ///< P.
  Vec2 aside{0.0};          ///< Unit length across the way, from the first to the second.
  double narrower_m = 0.0;  ///< W; 0 where they pass nowhere.
};
Passing passing(const Outline& first, const Outline& second, const Vec2& way);

}  // namespace septet::impact

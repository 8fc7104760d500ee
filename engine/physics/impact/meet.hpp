#pragma once
/// Two bodies meet: from their outlines and motion to the pulse that they exchange.
///
/// Steps are long against an impact (at 60 m/s a car moves by half a metre in a tick), so the touch is looked for
/// backwards in time within the last step: its normal, its point and its age are those of the instant when the gap
/// closed, not of the depth that happened to be met. The point is then put in the middle of the stretch that is engaged
/// at the end of compression.
///
/// A contact is only as strong as it is deep: bodies that overlap by some centimetres seen along their motion need only
/// bend by those to be past each other, and no more of their approach is stopped than a crush of that depth stops
/// (passing_depth_m, crush_curve.hpp). So a scrape is felt, and is not a collision of two fronts.

#include <optional>

#include "engine/physics/impact/outline.hpp"
#include "engine/physics/impact/pulse.hpp"

namespace septet::impact {

struct Side {
  Body body;
  Outline outline;
  Crush crush{};  ///< Unused where the mass is infinite.
};

/// The side with its outline carried along to the body's new place and heading.
Side carried(const Side& side, const Body& body);

/// The body and its outline as they were `time_s` ago, at its present velocity and yaw rate.
Side moved_back(const Side& side, double time_s);

/// The instant when the outlines closed, within the last `back_s`.
struct Touch {
  Place place;  ///< At that instant, in the world.
  double age_s = 0.0;
};
/// Empty where they do not overlap. Those that overlapped all the time touch now, at their contact.
std::optional<Touch> touch_of(const Side& first, const Side& second, double back_s);

/// What begins at a touch: a pulse of that age, none of it given yet (its first advance makes up for the age).
struct Impact {
  Touch touch;
  Pulse pulse;
};
/// Empty where the outlines do not overlap, where the surfaces do not approach, or where both sides stand fast.
/// Call it in the step in which two bodies that were apart overlap; `friction`: of this pair of surfaces.
std::optional<Impact> meet(const Side& first, const Side& second, double friction, double back_s);

}  // namespace septet::impact

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
/// (passing, crush_curve.hpp). So a scrape is felt, and is not a collision of two fronts.
///
/// A body that other pulses still push meets with the motion that those will leave it: what one contact stops, another
/// does not stop again.

#include <optional>

#include "engine/physics/impact/outline.hpp"
#include "engine/physics/impact/pulse.hpp"

namespace septet::impact {

struct Side {
  Body body;
  Outline outline;
  Crush crush{};  ///< Unused where the mass is infinite.
  /// Where it is met it has been crushed so far before, in impacts that are over: it is stiffer there from the start.
  double crushed_m = 0.0;
};

/// What pulses of other contacts will still change of a body's motion.
struct Due {
  Vec2 velocity_mps{0.0};
  double yaw_rate_radps = 0.0;
  bool runs = false;  ///< There are such pulses.
};
/// Adds what is left of a pulse, on its first body of these masses.
void add_due(const Pulse& pulse, const Body& first, Due& due);
/// Likewise on its second body.
void add_due_to_second(const Pulse& pulse, const Body& second, Due& due);
/// Gives a body all that is due to it.
void give(const Due& due, Body& body);

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
  /// By how much the outlines give aside where they only scrape past each other; else 0.
  double aside_m = 0.0;
  Vec2 aside{0.0};  ///< Unit length, from the first to the second.
};
/// Empty where the outlines do not overlap, where the surfaces do not approach, or where both sides stand fast.
/// Call it in the step in which two bodies that were apart overlap; `friction`: of this pair of surfaces.
std::optional<Impact> meet(const Side& first, const Side& second, double friction, double back_s, const Due& due = {},
                           const Due& due_to_second = {});

/// What begins at a place that the outlines have reached, `from_m` of crush behind them. Both bodies with all that is
/// due to them.
std::optional<Impact> impact_at(const Touch& touch, const Side& first, const Side& second, double friction,
                                double from_m);

}  // namespace septet::impact

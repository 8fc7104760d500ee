#pragma once
/// Two bodies from their touch until they are apart: the pulses that run between them, and how far they are crushed.
///
/// The closed form holds the arms, but bodies slide along each other and turn while they crush, and after it a tail may
/// swing in. So each step looks whether the crushed outlines overlap: the outlines less what has been crushed off them,
/// place by place (cut_off, outline.hpp). Where they do, and would still approach at that place with all that runs
/// given, they meet again there: a further pulse, whose crush goes on from the depth that is reached there. Where they
/// would not, a running pulse crushes them so far; where none runs, and they have turned into each other, they are set
/// apart by the overlap: their common mass centre stays, and so do all velocities. An overlap that no motion within the
/// step explains (the next stretch of a wall) is taken for crushed. Crushed outlines thus never overlap by more than
/// some millimetres. They stay as they are until the caller forgets the engagement.
///
/// Plain data for the caller to keep and save, one for each pair that is engaged. Bodies are in world coordinates.

#include <optional>
#include <vector>

#include "engine/physics/impact/meet.hpp"

namespace septet::impact {

struct Engagement {
  std::vector<Pulse> pulses;  ///< Running, in the order of their beginnings.
  Cuts first, second;         ///< Crushed off either outline, as it will be when the compressions begun are over.
  Ledger ledger;              ///< Of all pulses, running ones included.
  Vec2 given_ns{0.0};         ///< Impulse on the second body so far.
  double set_apart_m = 0.0;   ///< Sum of what they were set apart.
};

/// Call it after each step in which both sides have moved by their motion before it, for every pair whose outlines may
/// overlap and every pair that is engaged. Pushes, moves and turns both sides by what is due. Returns the impact that
/// begins in this step, if one does. `friction`: of this pair of surfaces.
/// Sides come with whole outlines. `due`, `due_to_second`: to either body, by pulses of other engagements.
std::optional<Impact> advance_engagement(double friction, double dt_s, Engagement& engagement, Side& first,
                                         Side& second, const Due& due = {}, const Due& due_to_second = {});

/// Gives both what is due of the pulses that run, and looks for no meeting: for those whose outlines are apart.
void advance_pulses(double dt_s, Engagement& engagement, Side& first, Side& second);

/// By how much cuts have taken a whole outline back along `way`, of unit length.
double crushed_off_m(const Outline& whole, const Cuts& cuts, const Vec2& way);

/// How far both are crushed along `normal` together.
double crush_along_m(const Engagement& engagement, const Outline& first, const Outline& second, const Vec2& normal);

/// The outline less what is crushed off it.
Outline crushed(const Outline& outline, const Cuts& cuts);

/// True where nothing runs and the outlines are apart: the caller may forget it.
bool is_over(const Engagement& engagement, const Outline& first, const Outline& second);

}  // namespace septet::impact

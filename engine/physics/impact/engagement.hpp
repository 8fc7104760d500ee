#pragma once
/// Two bodies from their touch until they are apart: the pulses that run between them, and how far they are crushed.
///
/// The closed form holds the arms, but bodies slide along each other and turn while they crush, and after it a tail may
/// swing in. So each step looks whether the outlines overlap by more than the crush so far. Where they do, and would
/// still approach at that place with all that runs given, they meet again there: a further pulse, whose crush goes on
/// from the depth that is reached. Where they would not, but have turned into each other while the arms were held, they
/// are set apart by what is beyond the crush: their common mass centre stays, and so do all velocities. The overlap thus
/// never passes the crush by more than some millimetres. Crushed outlines stay as they were: what overlaps by no more
/// than the crush does not touch.
///
/// Plain data for the caller to keep and save, one for each pair that is engaged. Bodies are in world coordinates.

#include <optional>
#include <vector>

#include "engine/physics/impact/meet.hpp"

namespace septet::impact {

struct Engagement {
  std::vector<Pulse> pulses;  ///< Running, in the order of their beginnings.
  double crush_m = 0.0;       ///< Overlap at the end of the compressions begun so far: both bodies' crushes.
  Ledger ledger;              ///< Of all pulses, running ones included.
  Vec2 given_ns{0.0};         ///< Impulse on the second body so far.
  double set_apart_m = 0.0;   ///< Sum of what they were set apart.
};

/// Call it after each step in which both sides have moved by their motion before it, for every pair whose outlines may
/// overlap and every pair that is engaged. Pushes, moves and turns both sides by what is due. Returns the impact that
/// begins in this step, if one does. `friction`: of this pair of surfaces.
std::optional<Impact> advance_engagement(double friction, double dt_s, Engagement& engagement, Side& first,
                                         Side& second);

/// True where nothing runs and the outlines are apart: the caller may forget it.
bool is_over(const Engagement& engagement, const Outline& first, const Outline& second);

}  // namespace septet::impact

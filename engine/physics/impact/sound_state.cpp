#include "engine/physics/impact/sound_state.hpp"

#include <algorithm>
#include <span>

#include <glm/geometric.hpp>

namespace septet::impact {
namespace {

constexpr double farthest_m = 1e3, hardest_mps2 = 1e9;

bool is_sound(const CrushCurve& curve) {
  if (curve.count < 1 || curve.count > curve.pieces.size()) return false;
  return std::ranges::all_of(std::span(curve.pieces).first(curve.count), [](const CrushPiece& piece) {
    return is_positive(piece.steepness_ps2) && is_within(piece.deceleration_mps2, 0.0, hardest_mps2) &&
           is_within(piece.depth_m, 0.0, farthest_m);
  });
}

bool is_sound(const Cuts& cuts) {
  if (cuts.count > cuts.each.size()) return false;
  return std::ranges::all_of(std::span(cuts.each).first(cuts.count), [](const Cut& cut) {
    return is_within(glm::length(cut.way), 0.999, 1.001) && is_within(cut.offset_m, -farthest_m, farthest_m);
  });
}

}  // namespace

bool is_sound(const Pulse& pulse) {
  return is_within(pulse.compression_s, 0.0, longest_pulse_s) && is_within(pulse.restitution_s, 0.0, longest_pulse_s) &&
         is_within(pulse.age_s, 0.0, longest_pulse_s) && is_within(pulse.restitution, 0.0, 1.0) &&
         is_positive(pulse.impulse.stopped_mps) && is_sound(pulse.curve);
}

bool is_sound(const Engagement& engagement) {
  return is_sound(engagement.first) && is_sound(engagement.second) &&
         std::ranges::all_of(engagement.pulses, [](const Pulse& pulse) { return is_sound(pulse); });
}

}  // namespace septet::impact

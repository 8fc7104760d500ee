#pragma once
/// Spherical interpolation without trigonometry in the loop.
///
/// Source: Hast, Barrera and Bengtsson, "Incremental Spherical Interpolation with Quadratically Varying Angle" (SIGRAD
/// 2006), eqs. 3 and 7–11.

#include "engine/core/expected.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet {

/// Share of a turn done at `t` in [0, 1] where the angle varies quadratically (eqs. 7–11): σt² + (1−σ)t.
constexpr double varied_share(double sigma, double t) { return (sigma * t + 1.0 - sigma) * t; }

/// The orientation at `t` in [0, 1] of a turn from `from` to `to` whose angle varies quadratically: angle(t) =
/// θ·varied_share(σ, t). σ = 0 turns at constant rate, σ > 0 speeds up, σ < 0 slows down; |σ| ≤ 1 (checked). The
/// shorter path is taken; equal orientations are returned exactly.
Quat slerp_quadratic(const Quat& from, const Quat& to, double sigma, double t);

/// σ of a turn with rate `rate_start` at its beginning and `rate_end` at its end (same unit, same axis): the angle's
/// slope runs from θ(1−σ) to θ(1+σ). Clamped to [−1, 1]; 0 where the rates do not determine it.
double sigma_from_rates(double rate_start, double rate_end);

}  // namespace septet

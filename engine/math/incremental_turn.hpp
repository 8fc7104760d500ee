#pragma once
/// Turning step by step, without trigonometry in the loop: unit vectors of any dimension.
///
/// Source: Hast, Barrera and Bengtsson, "Incremental Spherical Interpolation with Quadratically Varying Angle" (SIGRAD
/// 2006). After n of k steps the angle is θ(σ(n/k)² + (1−σ)n/k) (eqs. 7–11); a step is two complex multiplications
/// (section 2, De Moivre). σ = 0 turns at constant rate, σ > 0 speeds up, σ < 0 slows down.
///
/// Rounding: in double the vectors stay unit length to 10⁻⁹ over 10⁴ steps, and nothing is renormalised, as the paper
/// says. In float they would leave it by 10⁻² within 10³ steps; there each factor is multiplied by (3 − |Z|²)/2, one
/// step of Newton's iteration. Here steps must be equal, as a film's frames are (sim-client/film/camera_path.hpp);
/// screens show instants that follow the server's clock, and wheels turn by many angles at once: they evaluate single
/// instants with slerp_quadratic and varied_share (spherical_interpolation.hpp).

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "engine/core/expected.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet {

template <std::floating_point Scalar, std::size_t Dimension>
using UnitVector = std::array<Scalar, Dimension>;

/// A complex number of length one: the angle turned so far, or in a step. Plain arithmetic: std::complex looks for NaN.
template <std::floating_point Scalar>
struct Turned {
  Scalar cosine = 1, sine = 0;

  static Turned by(Scalar angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }
  friend Turned operator*(Turned a, Turned b) {
    return {a.cosine * b.cosine - a.sine * b.sine, a.cosine * b.sine + a.sine * b.cosine};
  }
  Turned renormalised() const {
    const Scalar factor = Scalar(1.5) - Scalar(0.5) * (cosine * cosine + sine * sine);
    return {cosine * factor, sine * factor};
  }
};

template <std::floating_point Scalar, std::size_t Dimension>
class IncrementalTurn {
 public:
  using Vector = UnitVector<Scalar, Dimension>;

  /// Turns from one unit vector to another in `steps` steps. Error: |sigma| > 1, no steps, vectors not of unit length
  /// (to 10⁻³), and antipodal ones, between which no path is the shortest. Equal vectors stay where they are.
  static Expected<IncrementalTurn> between(const Vector& from, const Vector& to, std::size_t steps, Scalar sigma = 0) {
    const auto refuse = [](const char* what, const char* remedy) {
      return failure(what, "turn between unit vectors", remedy);
    };
    if (!(std::abs(sigma) <= 1)) return refuse("|sigma| is over 1", "give a sigma from -1 to 1");
    if (steps == 0) return refuse("there is no step", "give at least one step");
    Scalar dot = 0, from_squared = 0, to_squared = 0;
    for (std::size_t n = 0; n < Dimension; ++n) {
      dot += from[n] * to[n];
      from_squared += from[n] * from[n];
      to_squared += to[n] * to[n];
    }
    if (!(std::abs(from_squared - 1) < Scalar(2e-3) && std::abs(to_squared - 1) < Scalar(2e-3)))
      return refuse("a vector is not of unit length", "normalise both");
    IncrementalTurn turn;
    turn.from_ = from;
    // One step of Gram and Schmidt; the length is sin θ (the paper's code before eq. 3).
    Scalar sine_squared = 0;
    for (std::size_t n = 0; n < Dimension; ++n) {
      turn.across_[n] = to[n] - dot * from[n];
      sine_squared += turn.across_[n] * turn.across_[n];
    }
    const Scalar sine = std::sqrt(sine_squared);
    constexpr Scalar least = std::is_same_v<Scalar, float> ? Scalar(1e-6) : Scalar(1e-12);
    if (sine < least) {
      if (dot < 0) return refuse("the vectors are antipodal", "turn through a third vector");
      turn.across_ = {};
      return turn;
    }
    for (Scalar& part : turn.across_) part /= sine;
    const auto count = static_cast<Scalar>(steps);
    turn.angle_rad_ = std::atan2(sine, dot);
    const Scalar a = sigma * turn.angle_rad_ / (count * count);
    const Scalar b = (1 - sigma) * turn.angle_rad_ / count;
    turn.step_ = Turned<Scalar>::by(a + b);
    turn.step_step_ = Turned<Scalar>::by(2 * a);
    return turn;
  }

  /// The vector of this step; the first is `from`.
  Vector value() const {
    Vector result;
    for (std::size_t n = 0; n < Dimension; ++n) result[n] = from_[n] * turned_.cosine + across_[n] * turned_.sine;
    return result;
  }
  void advance() {
    turned_ = turned_ * step_;
    step_ = step_ * step_step_;
    if constexpr (std::is_same_v<Scalar, float>) {
      turned_ = turned_.renormalised();
      step_ = step_.renormalised();
    }
  }

 private:
  Vector from_{}, across_{};
  Turned<Scalar> turned_, step_, step_step_;
  Scalar angle_rad_ = 0;
};

}  // namespace septet

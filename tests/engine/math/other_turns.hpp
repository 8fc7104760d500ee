#pragma once
/// Other ways to turn step by step, beside IncrementalTurn in tests and benchmarks: Chebyshev's recurrence, which the paper
/// names as the fastest for equal angles, and many orientations at once.

#include <array>
#include <cmath>
#include <cstddef>

#include "engine/math/incremental_turn.hpp"

namespace septet {

/// Equal angles by q(n + 1) = 2 cos(K) q(n) − q(n − 1) (Barrera, Hast and Bengtsson 2004): a product and a difference a
/// component. Errors grow with the number of steps over their angle.
template <std::size_t Dimension>
class ChebyshevTurn {
 public:
  using Vector = UnitVector<double, Dimension>;

  /// Between unit vectors that are neither equal nor antipodal.
  ChebyshevTurn(const Vector& from, const Vector& to, std::size_t steps) : here_(from) {
    auto turn = *IncrementalTurn<double, Dimension>::between(from, to, steps);
    turn.advance();
    const Vector next = turn.value();
    double cosine = 0.0;
    for (std::size_t n = 0; n < Dimension; ++n) cosine += from[n] * next[n];
    twice_cosine_ = 2.0 * cosine;
    for (std::size_t n = 0; n < Dimension; ++n) before_[n] = twice_cosine_ * from[n] - next[n];
  }
  const Vector& value() const { return here_; }
  void advance() {
    for (std::size_t n = 0; n < Dimension; ++n) {
      const double next = twice_cosine_ * here_[n] - before_[n];
      before_[n] = here_[n], here_[n] = next;
    }
  }

 private:
  Vector before_{}, here_;
  double twice_cosine_ = 2.0;
};

/// Orientations that turn by quadratic angles in step, in flat arrays of a length that the compiler knows.
template <std::size_t Count>
class TurnChannels {
 public:
  using Row = std::array<double, Count>;
  struct Channel {
    UnitVector<double, 4> from{1.0, 0.0, 0.0, 0.0}, to{0.0, 1.0, 0.0, 0.0};
    double sigma = 0.0;
  };
  /// Each pair lies less than half a circle apart and more than none.
  TurnChannels(const std::array<Channel, Count>& channels, std::size_t steps) {
    const double k = static_cast<double>(steps);
    for (std::size_t i = 0; i < Count; ++i) {
      const Channel& channel = channels[i];
      double dot = 0.0;
      for (std::size_t n = 0; n < 4; ++n) dot += channel.from[n] * channel.to[n];
      const double sine = std::sqrt(1.0 - dot * dot), angle_rad = std::atan2(sine, dot);
      for (std::size_t n = 0; n < 4; ++n) {
        from_[n][i] = channel.from[n];
        across_[n][i] = (channel.to[n] - dot * channel.from[n]) / sine;
      }
      const double a = channel.sigma * angle_rad / (k * k), b = (1.0 - channel.sigma) * angle_rad / k;
      turned_.cosine[i] = 1.0, turned_.sine[i] = 0.0;
      step_.cosine[i] = std::cos(a + b), step_.sine[i] = std::sin(a + b);
      step_step_.cosine[i] = std::cos(2.0 * a), step_step_.sine[i] = std::sin(2.0 * a);
    }
  }
  void advance() {
    turned_.turn(step_);
    step_.turn(step_step_);
  }
  /// Component n of all orientations.
  void write(std::size_t n, Row& component) const {
    for (std::size_t i = 0; i < Count; ++i)
      component[i] = from_[n][i] * turned_.cosine[i] + across_[n][i] * turned_.sine[i];
  }

 private:
  struct Turns {
    Row cosine{}, sine{};
    void turn(const Turns& by) {
      for (std::size_t i = 0; i < Count; ++i) {
        const double c = cosine[i], s = sine[i];
        cosine[i] = c * by.cosine[i] - s * by.sine[i];
        sine[i] = c * by.sine[i] + s * by.cosine[i];
      }
    }
  };
  std::array<Row, 4> from_{}, across_{};
  Turns turned_, step_, step_step_;
};

}  // namespace septet

#pragma once
/// Differences of a person's perception from the state of the world: it wanders, and it is late.

#include <cmath>
#include <deque>
#include <utility>

#include "engine/core/random.hpp"

namespace septet::driver {

/// A wandering error: an Ornstein–Uhlenbeck process, sampled exactly for any step.
struct WanderingError {
  double value = 0.0;

  double advance(double sd, double correlation_s, double dt_s, Random& random) {
    const double kept = std::exp(-dt_s / correlation_s);
    value = kept * value + sd * std::sqrt(1.0 - kept * kept) * random.normal();
    return value;
  }
};

/// Delay of a perception by `delay_s`.
template <class Seen>
class ReactionDelay {
 public:
  /// Takes the present view and returns the one of `delay_s` ago, or the first ever.
  const Seen& through(double now_s, Seen seen, double delay_s) {
    past_.emplace_back(now_s, std::move(seen));
    while (past_.size() > 1 && past_[1].first <= now_s - delay_s) past_.pop_front();
    return past_.front().second;
  }

 private:
  std::deque<std::pair<double, Seen>> past_;
};

}  // namespace septet::driver

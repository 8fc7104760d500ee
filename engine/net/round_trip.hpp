#pragma once
/// Smoothed round trip and its mean deviation (RFC 6298 §2), and the resend time that follows.

#include <algorithm>
#include <cmath>

namespace septet::net {

class RoundTrip {
 public:
  void add(double sample_s) {
    latest_s_ = sample_s;
    if (!known_) {
      smoothed_s_ = sample_s;
      deviation_s_ = sample_s / 2.0;
      known_ = true;
      return;
    }
    deviation_s_ += (std::abs(smoothed_s_ - sample_s) - deviation_s_) / 4.0;
    smoothed_s_ += (sample_s - smoothed_s_) / 8.0;
  }
  double smoothed_s() const { return smoothed_s_; }
  /// Age beyond an acknowledged successor at which a packet counts as lost (RFC 9002 §6.1.2).
  double reordering_s() const { return std::max(1.125 * std::max(smoothed_s_, latest_s_), 0.001); }
  double resend_s() const { return std::max(smoothed_s_ + 4.0 * deviation_s_, 0.002); }

 private:
  bool known_ = false;
  double latest_s_ = 0.0;
  double smoothed_s_ = 0.010;  ///< Value before the first sample.
  double deviation_s_ = 0.010;
};

}  // namespace septet::net

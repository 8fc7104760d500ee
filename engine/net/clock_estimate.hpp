#pragma once
/// The server's clock as a client sees it.
///
/// The offset between the two clocks lies, for sure, between server − received and server − sent: that is all that one ping
/// says. What the latest pings say holds together: the interval that all of them leave, each first widened by what two clocks
/// may drift apart in its age (Marzullo and Owicki 1983, "Maintaining the time in a distributed system"); its middle is
/// believed. Its two ends are as a rule of two pings, of the quickest way there and of the quickest way back, so that it is
/// far narrower than the shortest round trip where queueing is now on this leg, now on that. A ping that contradicts the
/// others tells that one of the clocks was set: what came before is forgotten.

#include <cstddef>
#include <deque>

namespace septet::net {

class ClockEstimate {
 public:
  /// One ping: sent and answered in the client's time, and the server's time when it answered.
  void add(double sent_s, double server_s, double received_s);

  bool valid() const { return !pings_.empty(); }
  /// How many pings it rests on: few at first, and after a clock was set.
  std::size_t pings() const { return pings_.size(); }
  /// server time = client time + offset.
  double offset_s() const;
  /// The offset is wrong by no more than this.
  double uncertainty_s() const;
  double server_time_s(double client_now_s) const { return client_now_s + offset_s(); }

 private:
  static constexpr std::size_t kept = 128;
  /// By how much two clocks may part: each is off by less than 100 ppm.
  static constexpr double drift = 200e-6;
  struct Ping {
    double at_s, low_s, high_s;  ///< Of the offset, when the answer came.
  };
  std::deque<Ping> pings_;
  double low_s_ = 0.0, high_s_ = 0.0;
};

}  // namespace septet::net

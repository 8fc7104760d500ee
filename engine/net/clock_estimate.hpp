#pragma once
/// Estimate of the server's clock on a client.
///
/// Each ping bounds the offset between the two clocks by server − received and server − sent. The estimate is the
/// middle of the intersection of the latest pings' intervals, each first widened by the drift possible in its age
/// (Marzullo and Owicki 1983, "Maintaining the time in a distributed system"). The intersection's two ends usually come
/// from two pings, the quickest one out and the quickest one back, so that it is far narrower than the shortest round
/// trip where queueing alternates between the directions. A ping that contradicts the others shows that one of the
/// clocks was set: earlier pings are dropped.

#include <cstddef>
#include <deque>

namespace septet::net {

class ClockEstimate {
 public:
  /// Adds one ping: sent and received in the client's time, replied to at `server_s` in the server's.
  void add(double sent_s, double server_s, double received_s);

  bool valid() const { return !pings_.empty(); }
  /// Number of pings behind the estimate: few at first, and after a clock was set.
  std::size_t pings() const { return pings_.size(); }
  /// server time = client time + offset.
  double offset_s() const;
  /// Bound on the error of the offset.
  double uncertainty_s() const;
  double server_time_s(double client_now_s) const { return client_now_s + offset_s(); }

 private:
  static constexpr std::size_t kept = 128;
  /// Bound on the relative drift of two clocks: each is off by less than 100 ppm.
  static constexpr double drift = 200e-6;
  struct Ping {
    double at_s, low_s, high_s;  ///< Interval of the offset at the time of the reply.
  };
  std::deque<Ping> pings_;
  double low_s_ = 0.0, high_s_ = 0.0;
};

}  // namespace septet::net

#pragma once
/// The server's clock as a client sees it: of the latest round trips the shortest one is believed,
/// because what a longer one adds is queueing, on an unknown leg of it (Mills 1991, "Internet time
/// synchronization", clock filter).

#include <cstddef>
#include <deque>
#include <optional>

namespace septet::net {

class ClockEstimate {
 public:
  /// One ping: sent and answered in the client's time, and the server's time when it answered.
  void add(double sent_s, double server_s, double received_s);
  void clear() { samples_.clear(); }

  bool valid() const { return !samples_.empty(); }
  /// server time = client time + offset; wrong by at most half the round trip.
  double offset_s() const;
  double round_trip_s() const;
  double server_time_s(double client_now_s) const { return client_now_s + offset_s(); }

 private:
  static constexpr std::size_t kept = 64;
  struct Sample {
    double offset_s, round_trip_s;
  };
  const Sample& best() const;
  std::deque<Sample> samples_;
};

}  // namespace septet::net

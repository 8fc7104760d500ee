#include "engine/net/clock_estimate.hpp"

#include <algorithm>

#include "engine/core/check.hpp"

namespace septet::net {

void ClockEstimate::add(double sent_s, double server_s, double received_s) {
  if (received_s < sent_s) return;
  samples_.push_back({server_s - (sent_s + received_s) / 2.0, received_s - sent_s});
  if (samples_.size() > kept) samples_.pop_front();
}

const ClockEstimate::Sample& ClockEstimate::best() const {
  SEPTET_CHECK(valid(), "asked for a clock without a sample");
  return *std::min_element(samples_.begin(), samples_.end(), [](const Sample& a, const Sample& b) {
    return a.round_trip_s < b.round_trip_s;
  });
}

double ClockEstimate::offset_s() const { return best().offset_s; }
double ClockEstimate::round_trip_s() const { return best().round_trip_s; }

}  // namespace septet::net

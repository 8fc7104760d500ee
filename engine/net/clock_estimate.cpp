#include "engine/net/clock_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/check.hpp"

namespace septet::net {

void ClockEstimate::add(double sent_s, double server_s, double received_s) {
  const Ping latest{received_s, server_s - received_s, server_s - sent_s};
  if (!std::isfinite(latest.low_s) || !std::isfinite(latest.high_s) || latest.low_s > latest.high_s) return;
  double low_s = latest.low_s, high_s = latest.high_s;
  for (const Ping& ping : pings_) {
    const double widened_s = drift * (received_s - ping.at_s);
    low_s = std::max(low_s, ping.low_s - widened_s);
    high_s = std::min(high_s, ping.high_s + widened_s);
  }
  if (low_s > high_s) {
    pings_.clear();
    low_s = latest.low_s;
    high_s = latest.high_s;
  }
  low_s_ = low_s;
  high_s_ = high_s;
  pings_.push_back(latest);
  if (pings_.size() > kept) pings_.pop_front();
}

double ClockEstimate::offset_s() const {
  SEPTET_CHECK(valid(), "asked for a clock without a ping");
  return (low_s_ + high_s_) / 2.0;
}

double ClockEstimate::uncertainty_s() const {
  SEPTET_CHECK(valid(), "asked for a clock without a ping");
  return (high_s_ - low_s_) / 2.0;
}

}  // namespace septet::net

#include "sim-server/host/playout_planner.hpp"

#include <algorithm>

namespace septet::server {

void SlidingMaximum::add(double value, double now_s) {
  while (!values_.empty() && values_.back().value <= value) values_.pop_back();
  values_.push_back({now_s, value});
}

double SlidingMaximum::at(double now_s, double otherwise) {
  while (!values_.empty() && values_.front().at_s < now_s - memory_s_) values_.pop_front();
  return values_.empty() ? otherwise : values_.front().value;
}

control::TickHeader PlayoutPlanner::header(double now_s, double simulated_time_s) {
  behind_.add(now_s - simulated_time_s, now_s);
  if (now_s >= next_from_s_) {
    current_s_ = next_s_;
    const double wanted_s = lateness_.at(now_s, least_s_ - 1.5 * tick_s_) + 1.5 * tick_s_;
    const double delay_s = std::clamp(wanted_s, least_s_, std::max(least_s_, largest_s));
    const double offset_s = delay_s + behind_.at(now_s, now_s - simulated_time_s);
    // Half a tick of hysteresis: a fluctuating offset would be visible as a shaking world.
    if (!started_ || offset_s > current_s_ || offset_s < current_s_ - 0.5 * tick_s_) {
      next_s_ = offset_s;
      delay_s_ = delay_s;
      next_from_s_ = now_s + notice_s;
      if (!started_) current_s_ = offset_s;
      started_ = true;
    }
  }
  return {now_s, current_s_, next_s_, next_from_s_};
}

}  // namespace septet::server

#include "sim-server/playout_planner.hpp"

#include <algorithm>

namespace septet::server {

PlayoutPlanner::PlayoutPlanner(double least_delay_s, double tick_s)
    : least_s_(least_delay_s), tick_s_(tick_s), current_s_(least_delay_s), next_s_(least_delay_s) {}

void PlayoutPlanner::observe(double lateness_s, double now_s) {
  while (!worst_.empty() && worst_.back().lateness_s <= lateness_s) worst_.pop_back();
  worst_.push_back({now_s, lateness_s});
}

control::TickHeader PlayoutPlanner::header(double now_s) {
  while (!worst_.empty() && worst_.front().at_s < now_s - memory_s) worst_.pop_front();
  if (now_s >= next_from_s_) {
    current_s_ = next_s_;
    const double wanted = worst_.empty() ? least_s_ : worst_.front().lateness_s + 1.5 * tick_s_;
    const double bounded = std::clamp(wanted, least_s_, std::max(least_s_, largest_s));
    // Half a tick of hysteresis: a delay that breathes would be seen as a shaking world.
    if (bounded > current_s_ || bounded < current_s_ - 0.5 * tick_s_) {
      next_s_ = bounded;
      next_from_s_ = now_s + notice_s;
    }
  }
  return {now_s, static_cast<float>(current_s_), static_cast<float>(next_s_), next_from_s_};
}

}  // namespace septet::server

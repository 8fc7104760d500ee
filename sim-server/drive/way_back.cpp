#include "sim-server/drive/way_back.hpp"

#include <algorithm>

namespace septet::server {

void WayBack::add(const logging::Sample& sample) {
  if (sample.lane != 0) samples_.push_back(sample);
  while (!samples_.empty() && samples_.front().simulated_time_s < sample.simulated_time_s - reaches_s)
    samples_.pop_front();
}

std::optional<simulation::PutCar> WayBack::place(double seconds_ago, double now_s) const {
  const auto after = std::ranges::upper_bound(samples_, now_s - seconds_ago, {}, &logging::Sample::simulated_time_s);
  if (after == samples_.begin()) return std::nullopt;
  const logging::Sample& then = *(after - 1);
  return simulation::PutCar{then.x_m, then.y_m, then.heading_rad,
                            seconds_ago > 0.0 ? std::clamp(then.speed_mps, 0.0, simulation::fastest_put_mps) : 0.0};
}

}  // namespace septet::server

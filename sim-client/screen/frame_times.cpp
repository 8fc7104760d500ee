#include "sim-client/screen/frame_times.hpp"

#include <algorithm>
#include <cmath>

namespace septet::screen {
namespace {
constexpr double smallest_ms = 0.01;
const double log_step = std::log(1.02);
}  // namespace

void FrameTimes::add(double ms) {
  const double bin = std::log(std::max(ms, smallest_ms) / smallest_ms) / log_step;
  ++bins_[std::min(static_cast<std::size_t>(bin), bins_.size() - 1)];
  ++count_;
}

double FrameTimes::percentile_ms(double fraction) const {
  const double wanted = fraction * static_cast<double>(count_);
  double seen = 0.0;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    seen += static_cast<double>(bins_[i]);
    if (bins_[i] != 0 && seen >= wanted) return smallest_ms * std::exp((static_cast<double>(i) + 0.5) * log_step);
  }
  return 0.0;
}

}  // namespace septet::screen

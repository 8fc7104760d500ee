#include "logging/study/measures/order_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace septet::logging {

std::optional<double> quantile(std::span<const double> numbers, double share) {
  std::vector<double> sorted;
  for (const double number : numbers)
    if (std::isfinite(number)) sorted.push_back(number);
  if (sorted.empty()) return std::nullopt;
  std::ranges::sort(sorted);
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace septet::logging

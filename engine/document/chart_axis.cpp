#include "engine/document/chart_axis.hpp"

#include <cmath>

#include <fmt/core.h>

namespace septet::document {
namespace {

double round_step(Range range, int count) {
  const double rough = (range.high - range.low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double nice : {1.0, 2.0, 2.5, 5.0})
    if (nice * power >= rough * (1.0 - 1e-9)) return nice * power;
  return 10.0 * power;
}

}  // namespace

Axis axis_of(Range range, double at_low, double at_high) {
  return {range.low, range.high == range.low ? range.low + 1.0 : range.high, at_low, at_high};
}

std::vector<double> round_ticks(Range range, int count) {
  if (!(range.high > range.low) || count < 1) return {range.low};
  const double step = round_step(range, count);
  std::vector<double> ticks;
  for (double k = std::ceil(range.low / step - 1e-9); k * step <= range.high + step * 1e-9; k += 1.0)
    ticks.push_back(k * step);
  return ticks;
}

Range round_range(Range range, int count) {
  if (!(range.high - range.low > 1e-9)) range = {range.low - 0.5, range.low + 0.5};
  const double step = round_step(range, count);
  return {std::floor(range.low / step + 1e-3) * step, std::ceil(range.high / step - 1e-3) * step};
}

std::string tick_label(double value, const std::vector<double>& ticks) {
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
  int decimals = 0;
  for (double scaled = step; decimals < 6 && std::abs(scaled - std::round(scaled)) > 1e-6 * scaled; scaled *= 10.0)
    ++decimals;
  // No minus before a zero.
  return fmt::format("{:.{}f}", std::abs(value) < 1e-9 * step ? 0.0 : value, decimals);
}

}  // namespace septet::document

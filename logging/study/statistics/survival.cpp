#include "logging/study/statistics/survival.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace septet::logging {
namespace {

std::size_t at_risk(std::span<const ObservedTime> group, double time_s) {
  return static_cast<std::size_t>(
      std::ranges::count_if(group, [&](const ObservedTime& o) { return o.time_s >= time_s; }));
}

std::size_t stopped_at(std::span<const ObservedTime> group, double time_s) {
  return static_cast<std::size_t>(
      std::ranges::count_if(group, [&](const ObservedTime& o) { return o.stopped && o.time_s == time_s; }));
}

std::set<double> times_of(std::span<const ObservedTime> group) {
  std::set<double> times;
  for (const ObservedTime& observation : group)
    if (observation.stopped) times.insert(observation.time_s);
  return times;
}

}  // namespace

std::vector<SurvivalStep> survival_curve(std::span<const ObservedTime> observations) {
  std::vector<SurvivalStep> curve;
  double share = 1.0, greenwood = 0.0;
  for (const double time_s : times_of(observations)) {
    const std::size_t risk = at_risk(observations, time_s), stopped = stopped_at(observations, time_s);
    const auto n = static_cast<double>(risk), d = static_cast<double>(stopped);
    share *= 1.0 - d / n;
    if (risk > stopped) greenwood += d / (n * (n - d));
    const double half = share > 0.0 ? 1.959963984540054 * share * std::sqrt(greenwood) : 0.0;
    curve.push_back({time_s, share, std::max(0.0, share - half), std::min(1.0, share + half), risk});
  }
  return curve;
}

std::optional<double> median_survival_s(std::span<const SurvivalStep> curve) {
  const auto half = std::ranges::find_if(curve, [](const SurvivalStep& step) { return step.share <= 0.5 + 1e-12; });
  return half == curve.end() ? std::nullopt : std::optional(half->time_s);
}

std::optional<LogRankTest> log_rank_test(std::span<const ObservedTime> first, std::span<const ObservedTime> second) {
  std::set<double> times = times_of(first);
  times.merge(times_of(second));
  double difference = 0.0, variance = 0.0;
  for (const double time_s : times) {
    const auto n1 = static_cast<double>(at_risk(first, time_s)), n2 = static_cast<double>(at_risk(second, time_s));
    const auto d1 = static_cast<double>(stopped_at(first, time_s)),
               d2 = static_cast<double>(stopped_at(second, time_s));
    const double n = n1 + n2, d = d1 + d2;
    difference += d1 - d * n1 / n;
    if (n > 1.0) variance += d * (n1 / n) * (n2 / n) * (n - d) / (n - 1.0);
  }
  if (!(variance > 0.0)) return std::nullopt;
  const double chi_square = difference * difference / variance;
  return LogRankTest{chi_square, std::erfc(std::sqrt(chi_square / 2.0))};
}

}  // namespace septet::logging

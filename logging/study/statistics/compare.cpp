#include "logging/study/statistics/compare.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <boost/math/distributions/students_t.hpp>

namespace septet::logging {
namespace {

constexpr double normal_95 = 1.959963984540054;

// NaN instead of an exception, as everywhere in these tables.
using NoThrow =
    boost::math::policies::policy<boost::math::policies::domain_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::overflow_error<boost::math::policies::ignore_error>>;
using StudentsT = boost::math::students_t_distribution<double, NoThrow>;

/// t with this two-sided p.
double t_of(double p, double degrees) { return quantile(complement(StudentsT(degrees), p / 2.0)); }

}  // namespace

double t_test_p(double t, double degrees) { return 2.0 * cdf(complement(StudentsT(degrees), std::abs(t))); }

MeanAndSpread summarise(std::span<const double> values) {
  MeanAndSpread summary{values.size(), 0.0, 0.0};
  for (const double value : values) summary.mean += value / static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - summary.mean) * (value - summary.mean);
  if (values.size() > 1) summary.sd = std::sqrt(squares / static_cast<double>(values.size() - 1));
  return summary;
}

std::optional<EffectSize> hedges_g(const MeanAndSpread& first, const MeanAndSpread& second) {
  if (first.n < 2 || second.n < 2) return std::nullopt;
  const auto n1 = static_cast<double>(first.n), n2 = static_cast<double>(second.n);
  const double degrees = n1 + n2 - 2.0;
  const double pooled = std::sqrt(((n1 - 1.0) * first.sd * first.sd + (n2 - 1.0) * second.sd * second.sd) / degrees);
  if (!(pooled > 0.0)) return std::nullopt;
  const double g = (1.0 - 3.0 / (4.0 * degrees - 1.0)) * (first.mean - second.mean) / pooled;
  const double error = std::sqrt((n1 + n2) / (n1 * n2) + g * g / (2.0 * (n1 + n2)));
  return EffectSize{g, g - normal_95 * error, g + normal_95 * error};
}

std::optional<EffectSize> hedges_g(std::span<const double> first, std::span<const double> second) {
  return hedges_g(summarise(first), summarise(second));
}

std::optional<WelchTest> welch_test(std::span<const double> first, std::span<const double> second) {
  const MeanAndSpread a = summarise(first), b = summarise(second);
  if (a.n < 2 || b.n < 2) return std::nullopt;
  const double va = a.sd * a.sd / static_cast<double>(a.n), vb = b.sd * b.sd / static_cast<double>(b.n);
  if (!(va + vb > 0.0)) return std::nullopt;
  WelchTest test;
  test.difference = a.mean - b.mean;
  test.t = test.difference / std::sqrt(va + vb);
  test.degrees =
      (va + vb) * (va + vb) / (va * va / static_cast<double>(a.n - 1) + vb * vb / static_cast<double>(b.n - 1));
  test.p = t_test_p(test.t, test.degrees);
  const double half = t_of(0.05, test.degrees) * std::sqrt(va + vb);
  test.low = test.difference - half;
  test.high = test.difference + half;
  return test;
}

std::optional<MannWhitneyTest> mann_whitney_test(std::span<const double> first, std::span<const double> second) {
  if (first.empty() || second.empty()) return std::nullopt;
  std::vector<std::pair<double, bool>> all;
  for (const double value : first) all.emplace_back(value, true);
  for (const double value : second) all.emplace_back(value, false);
  std::ranges::sort(all);
  double ranks_of_first = 0.0, ties = 0.0;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i;
    while (end < all.size() && all[end].first == all[i].first) ++end;
    const double rank = static_cast<double>(i + end + 1) / 2.0, tied = static_cast<double>(end - i);
    for (std::size_t k = i; k < end; ++k) ranks_of_first += all[k].second ? rank : 0.0;
    ties += tied * tied * tied - tied;
    i = end;
  }
  const auto n1 = static_cast<double>(first.size()), n2 = static_cast<double>(second.size()), n = n1 + n2;
  MannWhitneyTest test{ranks_of_first - n1 * (n1 + 1.0) / 2.0, 1.0};
  const double variance = n1 * n2 / 12.0 * (n + 1.0 - ties / (n * (n - 1.0)));
  if (!(variance > 0.0)) return test;
  const double away = std::max(0.0, std::abs(test.u - n1 * n2 / 2.0) - 0.5);
  test.p = std::erfc(away / std::sqrt(variance) / std::numbers::sqrt2);
  return test;
}

}  // namespace septet::logging

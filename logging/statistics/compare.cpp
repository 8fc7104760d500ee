#include "logging/statistics/compare.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace septet::logging {
namespace {

constexpr double normal_95 = 1.959963984540054;

/// Lentz's evaluation of the continued fraction of the incomplete beta function (Abramowitz and Stegun 26.5.8).
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  const auto kept_from_0 = [](double value) { return std::abs(value) < tiny ? tiny : value; };
  double c = 1.0, d = 1.0 / kept_from_0(1.0 - (a + b) * x / (a + 1.0)), value = d;
  for (int m = 1; m <= 500; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1.0 / kept_from_0(1.0 + even * d);
    c = kept_from_0(1.0 + even / c);
    value *= c * d;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1.0 / kept_from_0(1.0 + odd * d);
    c = kept_from_0(1.0 + odd / c);
    value *= c * d;
    if (std::abs(c * d - 1.0) < 1e-15) break;
  }
  return value;
}

double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  // The fraction converges fast on this side of the mean.
  return x < (a + 1.0) / (a + b + 2.0) ? front * beta_fraction(a, b, x) / a
                                       : 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

/// t with this two-sided p, by halving.
double t_of(double p, double degrees) {
  double low = 0.0, high = 1e6;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2.0;
    (t_test_p(middle, degrees) > p ? low : high) = middle;
  }
  return (low + high) / 2.0;
}

}  // namespace

double t_test_p(double t, double degrees) { return incomplete_beta(degrees / 2.0, 0.5, degrees / (degrees + t * t)); }

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

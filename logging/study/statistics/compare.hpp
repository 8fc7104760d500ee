#pragma once
/// Comparison of two groups: size of the difference, and two tests.

#include <optional>
#include <span>

namespace septet::logging {

struct MeanAndSpread {
  std::size_t n = 0;
  double mean = 0.0, sd = 0.0;  ///< SD divides by n − 1; 0 of fewer than two.
};
MeanAndSpread summarise(std::span<const double> values);

/// Hedges' g: the difference of the means over the pooled SD, times J = 1 − 3/(4 df − 1); the interval is g ± 1.96 of
/// its standard error, (n₁ + n₂)/(n₁n₂) + g²/(2(n₁ + n₂)) (Hedges and Olkin 1985).
struct EffectSize {
  double g = 0.0, low = 0.0, high = 0.0;  ///< 95 % interval.
};
/// Empty with fewer than two in a group, or without any spread.
std::optional<EffectSize> hedges_g(std::span<const double> first, std::span<const double> second);
std::optional<EffectSize> hedges_g(const MeanAndSpread& first, const MeanAndSpread& second);

/// Welch's test: unequal variances, Satterthwaite's degrees of freedom, two-sided.
struct WelchTest {
  double difference = 0.0, low = 0.0, high = 0.0;  ///< Difference of the means, with its 95 % interval.
  double t = 0.0, degrees = 0.0, p = 1.0;
};
std::optional<WelchTest> welch_test(std::span<const double> first, std::span<const double> second);

/// Mann and Whitney's test, two-sided, by the normal approximation with corrections for ties and continuity.
struct MannWhitneyTest {
  double u = 0.0, p = 1.0;
};
std::optional<MannWhitneyTest> mann_whitney_test(std::span<const double> first, std::span<const double> second);

/// Two-sided p of Student's t.
double t_test_p(double t, double degrees);

}  // namespace septet::logging

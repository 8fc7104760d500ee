#pragma once
/// Survival: the time for which people go on, with censoring of those who had not stopped when last observed.

#include <optional>
#include <span>
#include <vector>

namespace septet::logging {

struct ObservedTime {
  double time_s = 0.0;
  bool stopped = true;  ///< False: censored, not stopped by then.
};

/// One step of the curve, at a time at which a participant stopped.
struct SurvivalStep {
  double time_s = 0.0;
  double share = 1.0;            ///< Share that goes on beyond this time.
  double low = 1.0, high = 1.0;  ///< 95 %, from Greenwood's variance, kept within 0 and 1.
  std::size_t at_risk = 0;       ///< Just before.
};
/// Kaplan and Meier 1958: the product of 1 − stopped / at risk.
std::vector<SurvivalStep> survival_curve(std::span<const ObservedTime> observations);
/// The first time at which half or fewer go on; empty if more do to the end.
std::optional<double> median_survival_s(std::span<const SurvivalStep> curve);

/// The log-rank test of two groups: (O − E)²/V, one degree of freedom.
struct LogRankTest {
  double chi_square = 0.0, p = 1.0;
};
std::optional<LogRankTest> log_rank_test(std::span<const ObservedTime> first, std::span<const ObservedTime> second);

}  // namespace septet::logging

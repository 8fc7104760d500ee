#pragma once
/// Median and other quantiles of a sample.

#include <optional>
#include <span>

namespace septet::logging {

/// The value below which a share of the numbers lies, interpolated linearly (Hyndman and Fan 1996, type 7, the default
/// of R and NumPy). 0 ≤ share ≤ 1. Non-finite numbers are skipped; empty without a number.
std::optional<double> quantile(std::span<const double> numbers, double share);

inline std::optional<double> median(std::span<const double> numbers) { return quantile(numbers, 0.5); }

}  // namespace septet::logging

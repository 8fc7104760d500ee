#pragma once
/// Median and other quantiles of a sample.

#include <optional>
#include <span>

namespace septet::logging {

/// The value below which a share of the numbers lies, between two of them in proportion (Hyndman and Fan 1996, type 7, as R and
/// NumPy do by default). 0 ≤ share ≤ 1. Nothing of no number; numbers that are not finite are not counted.
std::optional<double> quantile(std::span<const double> numbers, double share);

inline std::optional<double> median(std::span<const double> numbers) { return quantile(numbers, 0.5); }

}  // namespace septet::logging

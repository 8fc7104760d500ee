#pragma once
/// Latencies of pictures, as counts of half milliseconds: constant size for any length of drive, p50 and p99 at its
/// end.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace septet::server {

class LatencyRecord {
 public:
  /// Longer times count in the last bin; negative ones and NaN do not count.
  void add(double seconds) {
    if (!(seconds >= 0.0)) return;
    ++bins_[static_cast<std::size_t>(std::min(seconds * bins_per_s, static_cast<double>(bins_.size() - 1)))];
    ++count_;
  }
  std::uint64_t count() const { return count_; }
  /// Upper end of the bin that contains this quantile, in milliseconds; empty without data.
  std::optional<double> quantile_ms(double share) const {
    if (count_ == 0) return std::nullopt;
    const auto rank =
        std::max<std::uint64_t>(static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_))), 1);
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < bins_.size(); ++i)
      if ((below += bins_[i]) >= rank) return 1000.0 * static_cast<double>(i + 1) / bins_per_s;
    return std::nullopt;
  }

 private:
  static constexpr double bins_per_s = 2000.0;
  std::array<std::uint32_t, 4000> bins_{};  ///< Up to two seconds.
  std::uint64_t count_ = 0;
};

}  // namespace septet::server

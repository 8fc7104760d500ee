#pragma once
/// How long pictures took, as counts of half milliseconds: a drive of any length, p50 and p99 at its end.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace septet::server {

class LatencyRecord {
 public:
  /// What is longer than the last bin counts there; what is negative or no number does not count.
  void add(double seconds) {
    if (!(seconds >= 0.0)) return;
    ++bins_[static_cast<std::size_t>(std::min(seconds * bins_per_s, static_cast<double>(bins_.size() - 1)))];
    ++count_;
  }
  std::uint64_t count() const { return count_; }
  /// The upper end of the bin below which that share lies, in milliseconds; nothing of nothing.
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
  std::array<std::uint32_t, 4000> bins_{};  ///< To two seconds.
  std::uint64_t count_ = 0;
};

}  // namespace septet::server

#pragma once
/// Durations of frames, for the median and the 99th percentile of a whole drive in bounded memory.

#include <array>
#include <cstdint>

namespace septet::screen {

/// Histogram with logarithmic bins of 2 %, from 10 µs up: percentiles are right within 1 %.
class FrameTimes {
 public:
  void add(double ms);
  /// Percentile of the durations; `fraction` 0.5 is the median; 0 without frames.
  double percentile_ms(double fraction) const;
  std::uint64_t count() const { return count_; }

 private:
  std::array<std::uint64_t, 1024> bins_{};
  std::uint64_t count_ = 0;
};

}  // namespace septet::screen

#pragma once
/// A measured curve of at most sixteen points: linear between them, straight on beyond the ends.
///
/// Fixed size, so that parameters are plain data and a look-up touches two cache lines. A table without points is zero.

#include <array>
#include <cstddef>

namespace septet::vehicle {

struct Table {
  static constexpr std::size_t capacity = 16;
  std::array<double, capacity> x{};  ///< Strictly increasing.
  std::array<double, capacity> y{};
  std::size_t count = 0;

  double operator()(double at) const {
    if (count == 0) return 0.0;
    if (count == 1) return y[0];
    const std::size_t i = segment(at);
    return y[i] + slope_of(i) * (at - x[i]);
  }
  double slope(double at) const { return count < 2 ? 0.0 : slope_of(segment(at)); }
  /// As operator(), but constant beyond the ends.
  double held(double at) const {
    if (count == 0) return 0.0;
    if (at <= x[0]) return y[0];
    return at >= x[count - 1] ? y[count - 1] : (*this)(at);
  }

 private:
  std::size_t segment(double at) const {
    std::size_t i = 0;
    while (i + 2 < count && at >= x[i + 1]) ++i;
    return i;
  }
  double slope_of(std::size_t i) const { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); }
};

}  // namespace septet::vehicle

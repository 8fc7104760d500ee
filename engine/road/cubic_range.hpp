#pragma once
/// The least and the greatest value of a cubic record over a stretch, exactly.

#include <algorithm>
#include <cmath>

#include "engine/road/cubic_record.hpp"

namespace septet::road {

struct ValueRange {
  double low = 0.0, high = 0.0;

  double magnitude() const { return std::max(std::abs(low), std::abs(high)); }
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Range over [from_s, to_s]; a stretch that ends before it begins is its beginning.
inline ValueRange value_range(const CubicRecord& record, double from_s, double to_s) {
  ValueRange range{record.value(from_s), record.value(from_s)};
  range.include(record.value(std::max(from_s, to_s)));
  // Roots of b + 2c·ds + 3d·ds² = 0, in the form that loses no digits.
  const double discriminant = record.c * record.c - 3.0 * record.b * record.d;
  if (!(discriminant >= 0.0)) return range;
  const double q = -(record.c + std::copysign(std::sqrt(discriminant), record.c));
  for (const double ds : {q / (3.0 * record.d), record.b / q}) {
    const double s = record.s_m + ds;
    if (s > from_s && s < to_s) range.include(record.value(s));
  }
  return range;
}

/// Range of the derivative by s.
inline ValueRange slope_range(const CubicRecord& record, double from_s, double to_s) {
  const CubicRecord slope{record.s_m, record.b, 2.0 * record.c, 3.0 * record.d, 0.0};
  return value_range(slope, from_s, to_s);
}

/// Calls visit(record, end) for every record and the station of its end, which is never before its beginning.
template <class Visit>
void visit_records(const CubicProfile& profile, double s_end, const Visit& visit) {
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double end = i + 1 < profile.size() ? profile[i + 1].s_m : s_end;
    visit(profile[i], std::max(profile[i].s_m, end));
  }
}

}  // namespace septet::road

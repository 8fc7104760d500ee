#pragma once
/// One record of a piecewise cubic function of s: value(s) = a + b·ds + c·ds² + d·ds³ with ds = s − s_m.
///
/// A profile is a vector of records sorted by s_m; a record holds until the next one begins (OpenDRIVE 1.8, §8.2 and
/// §10.4). A record's own sOffset has been turned into a station on the road when the file was read.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace septet::road {

struct CubicRecord {
  double s_m = 0.0;
  double a = 0.0, b = 0.0, c = 0.0, d = 0.0;

  double value(double s) const {
    const double ds = s - s_m;
    return a + ds * (b + ds * (c + ds * d));
  }
  double slope(double s) const {
    const double ds = s - s_m;
    return b + ds * (2.0 * c + ds * 3.0 * d);
  }
};

using CubicProfile = std::vector<CubicRecord>;

/// Index of the last record with s_m ≤ s, or 0 before the first one; the records are sorted and not empty.
template <class Record>
std::size_t record_at(const std::vector<Record>& records, double s_m) {
  if (records.size() == 1 || s_m < records[1].s_m) return 0;
  const auto after = std::upper_bound(records.begin() + 2, records.end(), s_m,
                                      [](double s, const Record& record) { return s < record.s_m; });
  return static_cast<std::size_t>(after - records.begin()) - 1;
}

/// The profile's value; 0 for an empty profile.
inline double value_at(const CubicProfile& profile, double s_m) {
  return profile.empty() ? 0.0 : profile[record_at(profile, s_m)].value(s_m);
}

/// The profile's derivative by s; 0 for an empty profile.
inline double slope_at(const CubicProfile& profile, double s_m) {
  return profile.empty() ? 0.0 : profile[record_at(profile, s_m)].slope(s_m);
}

}  // namespace septet::road

#include "logging/study/measures/following.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "logging/study/measures/order_statistics.hpp"

namespace septet::logging {
namespace {

FollowingStatistics statistics_of(const std::vector<double>& times_s, double close_s) {
  FollowingStatistics result;
  if (times_s.empty()) return result;
  const auto count = static_cast<double>(times_s.size());
  result.smallest_s = *std::ranges::min_element(times_s);
  result.median_s = median(times_s);
  result.mean_s = std::accumulate(times_s.begin(), times_s.end(), 0.0) / count;
  result.close_share =
      static_cast<double>(std::ranges::count_if(times_s, [&](double time_s) { return time_s < close_s; })) / count;
  return result;
}

}  // namespace

FollowingMeasures compute_following(std::span<const Sample> samples, const FollowingSettings& settings) {
  FollowingMeasures measures;
  std::vector<double> headways_s, gaps_s;
  for (const Sample& sample : samples) {
    if (!sample.leader) {
      ++measures.no_leader;
    } else if (!(sample.speed_mps > settings.least_speed_mps)) {
      ++measures.too_slow;
    } else if (const double headway_s = sample.leader->distance_headway_m / sample.speed_mps;
               !(headway_s <= settings.longest_s)) {
      ++measures.farther;
    } else {
      headways_s.push_back(headway_s);
      gaps_s.push_back(sample.leader->distance_gap_m / sample.speed_mps);
    }
  }
  measures.samples = headways_s.size();
  measures.headway = statistics_of(headways_s, settings.close_s);
  measures.gap = statistics_of(gaps_s, settings.close_s);
  return measures;
}

}  // namespace septet::logging

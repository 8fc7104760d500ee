#include "engine/traffic/lane_order.hpp"

#include <algorithm>

namespace septet::traffic {
namespace {

bool before(const LaneEntry& a, const LaneEntry& b) { return a.x_m != b.x_m ? a.x_m < b.x_m : a.vehicle < b.vehicle; }

}  // namespace

void repair_order(std::vector<LaneEntry>& lane) {
  for (std::size_t i = 1; i < lane.size(); ++i) {
    if (!before(lane[i], lane[i - 1])) continue;
    const LaneEntry entry = lane[i];
    std::size_t k = i;
    for (; k > 0 && before(entry, lane[k - 1]); --k) lane[k] = lane[k - 1];
    lane[k] = entry;
  }
}

void insert_entry(std::vector<LaneEntry>& lane, const LaneEntry& entry) {
  lane.insert(std::upper_bound(lane.begin(), lane.end(), entry, before), entry);
}

std::size_t first_ahead(const std::vector<LaneEntry>& lane, double x_m, std::size_t hint) {
  std::size_t at = std::min(hint, lane.size());
  while (at < lane.size() && lane[at].x_m <= x_m) ++at;
  while (at > 0 && lane[at - 1].x_m > x_m) --at;
  return at;
}

}  // namespace septet::traffic

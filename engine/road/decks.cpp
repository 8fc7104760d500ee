#include "engine/road/decks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/road/cross_section.hpp"
#include "engine/road/lane_geometry.hpp"

namespace septet::road {
namespace {

constexpr double step_m = 1.5;  ///< Between the points of a stretch, along and across.
constexpr double over_m = 0.75 * step_m;
constexpr double least_gap_m = 12.0;  ///< Between two decks; nearer ones are one.

struct Range {
  double from_m = 0.0, to_m = 0.0;
};

/// A stretch's axis, for a first look.
struct Heights {
  double low_m = 1e300, high_m = -1e300;
};
Heights heights_of(const RoadNetwork& network, const StretchNode& stretch) {
  constexpr int looks = 4;
  const Road& road = network.roads[stretch.road];
  Heights heights;
  for (int i = 0; i <= looks; ++i) {
    const double s = stretch.s_m + stretch.step_m * i / looks;
    const CrossSection section = cross_section_at(road, s);
    const RoadExtent extent = road_extent(road, s);
    for (const double t : {extent.left_t_m, extent.right_t_m}) {
      const double z = section.z_m + t * section.sin_roll;
      heights.low_m = std::min(heights.low_m, z);
      heights.high_m = std::max(heights.high_m, z);
    }
  }
  return heights;
}

/// A row across the road, from one edge to the other.
struct Row {
  double s_m = 0.0;
  std::vector<Vec3> points_m;
};
std::vector<Row> rows_of(const RoadNetwork& network, const StretchNode& stretch) {
  const Road& road = network.roads[stretch.road];
  const int count = std::max(1, static_cast<int>(std::ceil(stretch.step_m / step_m)));
  std::vector<Row> rows;
  for (int i = 0; i <= count; ++i) {
    Row row{stretch.s_m + stretch.step_m * i / count, {}};
    if (structure_at(road, row.s_m, RoadStructure::Kind::tunnel)) continue;
    const CrossSection section = cross_section_at(road, row.s_m);
    const RoadExtent extent = road_extent(road, row.s_m);
    const double width = extent.left_t_m - extent.right_t_m;
    const int across = std::max(1, static_cast<int>(std::ceil(width / step_m)));
    for (int k = 0; width > 0.1 && k <= across; ++k)
      row.points_m.push_back(section.place(extent.right_t_m + width * k / across, 0.0));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Adds the stations of the rows `above` that have a lane of the rows `below` under them to `ranges`.
void find_over(const std::vector<Row>& above, const std::vector<Row>& below, std::vector<Range>& ranges) {
  const auto lies_over = [&](const Vec3& p) {
    return std::ranges::any_of(below, [&](const Row& row) {
      return std::ranges::any_of(row.points_m, [&](const Vec3& q) {
        const Vec2 apart = Vec2(p) - Vec2(q);
        return p.z > q.z + least_rise_m && glm::dot(apart, apart) < over_m * over_m;
      });
    });
  };
  for (const Row& row : above)
    if (std::ranges::any_of(row.points_m, lies_over)) ranges.push_back({row.s_m, row.s_m});
}

std::vector<Range> joined(std::vector<Range> ranges, double gap_m) {
  std::ranges::sort(ranges, {}, &Range::from_m);
  std::vector<Range> result;
  for (const Range& range : ranges) {
    if (!result.empty() && range.from_m <= result.back().to_m + gap_m)
      result.back().to_m = std::max(result.back().to_m, range.to_m);
    else
      result.push_back(range);
  }
  return result;
}

/// The part of a deck beyond its road's end lies on the roads that are linked to it there.
void carry_on(const RoadNetwork& network, RoadIndex from, bool at_end, double beyond_m,
              std::vector<std::vector<Range>>& decks) {
  for (RoadIndex index = 0; index < network.roads.size(); ++index) {
    const Road& road = network.roads[index];
    const double reach_m = std::min(beyond_m, road.length_m);
    const auto meets = [&](const RoadLink& link) {
      return link.road == from && (link.contact == ContactPoint::end) == at_end;
    };
    if (meets(road.predecessor)) decks[index].push_back({0.0, reach_m});
    if (meets(road.successor)) decks[index].push_back({road.length_m - reach_m, road.length_m});
  }
}

/// Marks the file's own bridges within the range; the rest of it, but for tunnels, becomes a bridge.
void add_deck(Road& road, Range deck) {
  std::vector<Range> left{deck};
  for (RoadStructure& structure : road.structures) {
    const double s1_m = structure.s_m + structure.length_m;
    if (structure.inferred || structure.s_m >= deck.to_m || s1_m <= deck.from_m) continue;
    if (structure.kind == RoadStructure::Kind::bridge) structure.over_road = true;
    std::vector<Range> rest;
    for (const Range& part : left) {
      if (part.from_m < structure.s_m) rest.push_back({part.from_m, std::min(part.to_m, structure.s_m)});
      if (part.to_m > s1_m) rest.push_back({std::max(part.from_m, s1_m), part.to_m});
    }
    left = std::move(rest);
  }
  for (const Range& part : left) {
    const double length_m = part.to_m - part.from_m;
    // A narrow rest beside a bridge of the file is its end.
    const bool is_rest = part.from_m > deck.from_m || part.to_m < deck.to_m;
    if (length_m <= 0.0 || (is_rest && length_m < 2.0 * deck_beyond_m)) continue;
    RoadStructure& bridge = road.structures.emplace_back();
    bridge.s_m = part.from_m;
    bridge.length_m = length_m;
    bridge.over_road = bridge.inferred = true;
  }
}

}  // namespace

void find_decks(RoadNetwork& network) {
  const std::vector<StretchNode>& tree = network.stretches;
  std::vector<Heights> heights(tree.size());
  for (std::size_t i = 0; i < tree.size(); ++i)
    if (tree[i].road != no_index) heights[i] = heights_of(network, tree[i]);
  // Whole branches without a second level are passed over.
  for (std::size_t i = tree.size(); i-- > 0;) {
    if (tree[i].road != no_index) continue;
    for (std::size_t child = i + 1; child < tree[i].skip; child = tree[child].skip) {
      heights[i].low_m = std::min(heights[i].low_m, heights[child].low_m);
      heights[i].high_m = std::max(heights[i].high_m, heights[child].high_m);
    }
  }
  // A stretch meets several others: its rows are worked out once, when the first of them asks.
  std::vector<std::optional<std::vector<Row>>> rows(tree.size());
  const auto rows_at = [&](std::size_t i) -> const std::vector<Row>& {
    if (!rows[i]) rows[i] = rows_of(network, tree[i]);
    return *rows[i];
  };
  std::vector<std::vector<Range>> over(network.roads.size());
  for (std::size_t upper = 0; upper < tree.size(); ++upper) {
    if (tree[upper].road == no_index) continue;
    for (std::size_t lower = 0; lower < tree.size();) {
      const bool apart = tree[lower].low_m.x > tree[upper].high_m.x || tree[lower].low_m.y > tree[upper].high_m.y ||
                         tree[lower].high_m.x < tree[upper].low_m.x || tree[lower].high_m.y < tree[upper].low_m.y;
      if (apart || heights[lower].low_m + least_rise_m > heights[upper].high_m) {
        lower = tree[lower].skip;
        continue;
      }
      if (tree[lower].road != no_index) find_over(rows_at(upper), rows_at(lower), over[tree[upper].road]);
      ++lower;
    }
  }
  std::vector<std::vector<Range>> decks(network.roads.size());
  for (RoadIndex index = 0; index < network.roads.size(); ++index) {
    const double length_m = network.roads[index].length_m;
    for (const Range& range : joined(std::move(over[index]), least_gap_m)) {
      const double from_m = range.from_m - deck_beyond_m, to_m = range.to_m + deck_beyond_m;
      decks[index].push_back({std::max(from_m, 0.0), std::min(to_m, length_m)});
      if (from_m < 0.0) carry_on(network, index, false, -from_m, decks);
      if (to_m > length_m) carry_on(network, index, true, to_m - length_m, decks);
    }
  }
  for (RoadIndex index = 0; index < network.roads.size(); ++index)
    for (const Range& deck : joined(std::move(decks[index]), 0.5 * least_gap_m)) add_deck(network.roads[index], deck);
}

}  // namespace septet::road

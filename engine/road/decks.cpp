#include "engine/road/decks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/road/cross_section.hpp"
#include "engine/road/lane_geometry.hpp"

namespace septet::road {
namespace {

constexpr double step_m = 1.5;  ///< Between the points of a stretch, along and across.
constexpr double over_m = 0.75 * step_m;
constexpr int most_across = 128;      ///< Points of a row. Wider roads, of damaged files, are looked at more coarsely.
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
    if (width > 0.1) {
      const int across = static_cast<int>(std::clamp(std::ceil(width / step_m), 1.0, double{most_across}));
      for (int k = 0; k <= across; ++k)
        row.points_m.push_back(section.place(extent.right_t_m + width * k / across, 0.0));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Points of rows in squares of the plan, so that a place looks at its neighbours alone however many points there are.
class PointGrid {
 public:
  void add(const std::vector<Row>& rows) {
    for (const Row& row : rows)
      for (const Vec3& point : row.points_m)
        if (const auto square = square_of(point)) squares_[*square].push_back(point);
  }

  /// True if a point lies under `p`, near it in plan.
  bool has_below(const Vec3& p) const {
    const auto square = square_of(p);
    if (!square) return false;
    for (std::int32_t i = -1; i <= 1; ++i)
      for (std::int32_t j = -1; j <= 1; ++j)
        if (const auto found = squares_.find({square->first + i, square->second + j}); found != squares_.end())
          if (std::ranges::any_of(found->second, [&](const Vec3& q) { return lies_over(p, q); })) return true;
    return false;
  }

 private:
  using Square = std::pair<std::int32_t, std::int32_t>;
  struct Hash {
    std::size_t operator()(const Square& square) const {
      return std::size_t{static_cast<std::uint32_t>(square.first)} * 0x9e37'79b9'7f4a'7c15u +
             static_cast<std::uint32_t>(square.second);
    }
  };

  /// Empty for a point farther out than any road.
  static std::optional<Square> square_of(const Vec3& p) {
    constexpr double farthest_m = 1e9;
    if (!(std::abs(p.x) < farthest_m && std::abs(p.y) < farthest_m)) return std::nullopt;
    return Square{static_cast<std::int32_t>(std::floor(p.x / over_m)),
                  static_cast<std::int32_t>(std::floor(p.y / over_m))};
  }
  static bool lies_over(const Vec3& p, const Vec3& q) {
    const Vec2 apart = Vec2(p) - Vec2(q);
    return p.z > q.z + least_rise_m && glm::dot(apart, apart) < over_m * over_m;
  }

  std::unordered_map<Square, std::vector<Vec3>, Hash> squares_;
};

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

/// Heights of the tree's stretches and branches.
std::vector<Heights> heights_of_tree(const RoadNetwork& network) {
  const std::vector<StretchNode>& tree = network.stretches;
  std::vector<Heights> heights(tree.size());
  for (std::size_t i = 0; i < tree.size(); ++i)
    if (tree[i].road != no_index) heights[i] = heights_of(network, tree[i]);
  for (std::size_t i = tree.size(); i-- > 0;) {
    if (tree[i].road != no_index) continue;
    for (std::size_t child = i + 1; child < tree[i].skip; child = tree[child].skip) {
      heights[i].low_m = std::min(heights[i].low_m, heights[child].low_m);
      heights[i].high_m = std::max(heights[i].high_m, heights[child].high_m);
    }
  }
  return heights;
}

/// Marks of stretches, by index, that may lie over another one, and of those that may lie under one.
struct Levels {
  std::vector<char> is_upper, is_lower;
};
Levels find_levels(const RoadNetwork& network) {
  const std::vector<StretchNode>& tree = network.stretches;
  const std::vector<Heights> heights = heights_of_tree(network);
  Levels levels{std::vector<char>(tree.size(), 0), std::vector<char>(tree.size(), 0)};
  for (std::size_t upper = 0; upper < tree.size(); ++upper) {
    if (tree[upper].road == no_index) continue;
    for (std::size_t lower = 0; lower < tree.size();) {
      const bool apart = tree[lower].low_m.x > tree[upper].high_m.x || tree[lower].low_m.y > tree[upper].high_m.y ||
                         tree[lower].high_m.x < tree[upper].low_m.x || tree[lower].high_m.y < tree[upper].low_m.y;
      // Whole branches without a second level are passed over.
      if (apart || heights[lower].low_m + least_rise_m > heights[upper].high_m) {
        lower = tree[lower].skip;
        continue;
      }
      if (tree[lower].road != no_index) levels.is_upper[upper] = levels.is_lower[lower] = 1;
      ++lower;
    }
  }
  return levels;
}

/// Stations, by road, that have a lane of some road under them.
std::vector<std::vector<Range>> stations_over(const RoadNetwork& network) {
  const std::vector<StretchNode>& tree = network.stretches;
  const Levels levels = find_levels(network);
  // A stretch may lie over one and under another: its rows are worked out once.
  std::vector<std::vector<Row>> rows(tree.size());
  PointGrid below;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (levels.is_upper[i] || levels.is_lower[i]) rows[i] = rows_of(network, tree[i]);
    if (levels.is_lower[i]) below.add(rows[i]);
  }
  std::vector<std::vector<Range>> over(network.roads.size());
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (!levels.is_upper[i]) continue;
    for (const Row& row : rows[i])
      if (std::ranges::any_of(row.points_m, [&](const Vec3& p) { return below.has_below(p); }))
        over[tree[i].road].push_back({row.s_m, row.s_m});
  }
  return over;
}

}  // namespace

void find_decks(RoadNetwork& network) {
  std::vector<std::vector<Range>> over = stations_over(network);
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

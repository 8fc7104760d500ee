#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/traffic/network/lane_graph_parts.hpp"

namespace septet::traffic {
namespace {

/// Roads farther over each other do not meet: one is a bridge.
constexpr double level_m = 3.0;

struct Box {
  Vec2 low_m{1e300}, high_m{-1e300};
};

Box box_of(const LaneGraph& graph, const Way& way) {
  Box box;
  for (std::uint32_t k = 0; k < way.points.count; ++k) {
    const Vec2 at(graph.points[way.points.first + k].position_m);
    box.low_m = glm::min(box.low_m, at);
    box.high_m = glm::max(box.high_m, at);
  }
  return box;
}

bool are_near(const Box& a, const Box& b, double within_m) {
  return a.low_m.x < b.high_m.x + within_m && b.low_m.x < a.high_m.x + within_m && a.low_m.y < b.high_m.y + within_m &&
         b.low_m.y < a.high_m.y + within_m;
}

bool share(std::span<const WayIndex> a, std::span<const WayIndex> b) {
  return std::ranges::any_of(a, [&](WayIndex way) { return std::ranges::find(b, way) != b.end(); });
}

/// How far the longest vehicle's ends, or its middle, are off the middle of a way where that is tightest: on a circle half
/// of the sagitta under its whole length.
double reaches_over_m(const Way& way) { return longest_rigid_m * longest_rigid_m * way.tightest_per_m / 16.0; }

/// The stretches of two ways that are nearer to each other than that.
std::optional<WayConflict> meet(const LaneGraph& graph, const Way& a, const Way& b, double within_m) {
  double from_a = 1e300, to_a = -1e300, from_b = 1e300, to_b = -1e300;
  const double step_a = a.length_m / static_cast<double>(a.points.count - 1);
  const double step_b = b.length_m / static_cast<double>(b.points.count - 1);
  for (std::uint32_t i = 0; i < a.points.count; ++i)
    for (std::uint32_t j = 0; j < b.points.count; ++j) {
      const Vec3 apart = graph.points[a.points.first + i].position_m - graph.points[b.points.first + j].position_m;
      if (apart.x * apart.x + apart.y * apart.y > within_m * within_m || std::abs(apart.z) > level_m) continue;
      const double at_a = i * step_a, at_b = j * step_b;
      from_a = std::min(from_a, at_a), to_a = std::max(to_a, at_a);
      from_b = std::min(from_b, at_b), to_b = std::max(to_b, at_b);
    }
  if (from_a > to_a) return std::nullopt;
  // Between two points a way may already be too near.
  WayConflict conflict;
  conflict.from_m = std::max(0.0, from_a - step_a), conflict.to_m = std::min(a.length_m, to_a + step_a);
  conflict.with_from_m = std::max(0.0, from_b - step_b), conflict.with_to_m = std::min(b.length_m, to_b + step_b);
  return conflict;
}

/// By what comes before and after the whole of two connecting roads.
WayConflict::Kind kind_of(const LaneGraph& graph, const Way& a, const Way& b) {
  const auto& ways = graph.ways;
  if (share(graph.before_of(ways[a.entry]), graph.before_of(ways[b.entry]))) return WayConflict::Kind::diverging;
  if (share(graph.next_of(ways[a.exit]), graph.next_of(ways[b.exit]))) return WayConflict::Kind::merging;
  return WayConflict::Kind::crossing;
}

/// True for two ways of one lane, one behind the other.
bool are_one_lane(const LaneGraph& graph, WayIndex a, WayIndex b) {
  const auto follows = [&](WayIndex from, WayIndex to) {
    const auto next = graph.next_of(graph.ways[from]);
    return std::ranges::find(next, to) != next.end();
  };
  return follows(a, b) || follows(b, a) || graph.ways[a].entry == graph.ways[b].entry;
}

WayConflict turned_round(const WayConflict& conflict, WayIndex with) {
  WayConflict turned = conflict;
  turned.with = with;
  std::swap(turned.from_m, turned.with_from_m);
  std::swap(turned.to_m, turned.with_to_m);
  return turned;
}

/// What two connecting roads of a junction have in common, from the begin of each.
struct Whole {
  double from_m = 1e300, to_m = -1e300, with_from_m = 1e300, with_to_m = -1e300;
};

/// Fills in the whole stretch of each conflict: sections of one connecting road are one after the other.
void join_sections(const LaneGraph& graph, const std::vector<WayIndex>& ways,
                   std::vector<std::vector<WayConflict>>& found) {
  std::map<std::pair<WayIndex, WayIndex>, Whole> wholes;
  const auto whole_of = [&](const Way& mine, const Way& his) -> Whole& { return wholes[{mine.entry, his.entry}]; };
  for (const WayIndex index : ways)
    for (const WayConflict& conflict : found[index]) {
      const Way &mine = graph.ways[index], &his = graph.ways[conflict.with];
      Whole& whole = whole_of(mine, his);
      whole.from_m = std::min(whole.from_m, mine.from_entry_m + conflict.from_m);
      whole.to_m = std::max(whole.to_m, mine.from_entry_m + conflict.to_m);
      whole.with_from_m = std::min(whole.with_from_m, his.from_entry_m + conflict.with_from_m);
      whole.with_to_m = std::max(whole.with_to_m, his.from_entry_m + conflict.with_to_m);
    }
  for (const WayIndex index : ways)
    for (WayConflict& conflict : found[index]) {
      const Way &mine = graph.ways[index], &his = graph.ways[conflict.with];
      const Whole& whole = whole_of(mine, his);
      conflict.whole_from_m = whole.from_m - mine.from_entry_m;
      conflict.whole_to_m = whole.to_m - mine.from_entry_m;
      conflict.with_whole_from_m = whole.with_from_m - his.from_entry_m;
      conflict.with_whole_to_m = whole.with_to_m - his.from_entry_m;
    }
}

}  // namespace

void find_conflicts(LaneGraph& graph) {
  std::map<std::uint32_t, std::vector<WayIndex>> junctions;
  for (WayIndex index = 0; index < graph.ways.size(); ++index)
    if (graph.ways[index].in_junction()) junctions[graph.ways[index].junction].push_back(index);

  std::vector<std::vector<WayConflict>> found(graph.ways.size());
  std::vector<std::vector<WayIndex>> found_long(graph.ways.size());
  for (const auto& [junction, ways] : junctions) {
    std::vector<Box> boxes;
    boxes.reserve(ways.size());
    for (const WayIndex index : ways) boxes.push_back(box_of(graph, graph.ways[index]));
    for (std::size_t i = 0; i < ways.size(); ++i)
      for (std::size_t j = i + 1; j < ways.size(); ++j) {
        const Way &a = graph.ways[ways[i]], &b = graph.ways[ways[j]];
        const double long_within_m = meeting_m + reaches_over_m(a) + reaches_over_m(b);
        if (!are_near(boxes[i], boxes[j], long_within_m)) continue;
        if (are_one_lane(graph, ways[i], ways[j])) continue;
        auto conflict = meet(graph, a, b, meeting_m);
        if (!conflict) {
          if (!meet(graph, a, b, long_within_m)) continue;
          found_long[ways[i]].push_back(ways[j]);
          found_long[ways[j]].push_back(ways[i]);
          continue;
        }
        conflict->kind = kind_of(graph, a, b);
        conflict->with = ways[j];
        found[ways[i]].push_back(*conflict);
        found[ways[j]].push_back(turned_round(*conflict, ways[i]));
      }
    join_sections(graph, ways, found);
  }
  for (WayIndex index = 0; index < graph.ways.size(); ++index) {
    graph.ways[index].conflicts = {static_cast<std::uint32_t>(graph.conflicts.size()),
                                   static_cast<std::uint32_t>(found[index].size())};
    graph.conflicts.insert(graph.conflicts.end(), found[index].begin(), found[index].end());
    graph.ways[index].long_conflicts = {static_cast<std::uint32_t>(graph.long_conflicts.size()),
                                        static_cast<std::uint32_t>(found_long[index].size())};
    graph.long_conflicts.insert(graph.long_conflicts.end(), found_long[index].begin(), found_long[index].end());
  }
}

}  // namespace septet::traffic

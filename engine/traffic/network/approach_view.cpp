#include "engine/traffic/network/approach_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/world/participant_sight.hpp"

namespace septet::traffic {
namespace {

constexpr double turns_from_rad = 0.5;
/// Between two places that are looked at; two hidden ones in a row can hide a car.
constexpr double look_step_m = 4.0;
constexpr double most_back_m = 100.0;
constexpr double always = std::numeric_limits<double>::infinity();

/// The way on which most come to this one: straight on.
WayIndex straight_before(const LaneGraph& graph, const Way& way) {
  WayIndex best = no_way;
  for (const WayIndex index : graph.before_of(way))
    if (best == no_way || std::abs(graph.ways[index].turns_rad) < std::abs(graph.ways[best].turns_rad)) best = index;
  return best;
}

/// The place so far before a way's begin, back along those who come straight on; empty beyond a road's open end.
std::optional<Vec3> place_before(const LaneGraph& graph, WayIndex index, double back_m) {
  constexpr int most_ways = 40;
  for (int k = 0; k < most_ways; ++k) {
    index = straight_before(graph, graph.ways[index]);
    if (index == no_way) return std::nullopt;
    const Way& way = graph.ways[index];
    if (back_m <= way.length_m) return place_on_way(graph, way, way.length_m - back_m).position_m;
    back_m -= way.length_m;
  }
  return std::nullopt;
}

/// What a look at a place meets. Who is `last` there comes before all farther back.
enum class Look : std::uint8_t { seen, hidden, last };

/// One that is looked for, so far before a way's begin; empty beyond a road's open end.
std::optional<Vec3> looked_for_at(const LaneGraph& graph, WayIndex entry, double back_m) {
  const auto place = place_before(graph, entry, back_m);
  if (!place) return std::nullopt;
  return *place + Vec3(0.0, 0.0, looked_for_height_m);
}

/// How far back all of the way is seen whose places a function gives, where no stretch as long as a car is hidden.
template <class PlaceAt, class LookAt>
double seen_back_m(const PlaceAt& place_at, double back_m, const LookAt& look_at) {
  double seen_m = 0.0;
  bool before_is_hidden = false;
  for (double m = 0.0; m <= back_m; m += look_step_m) {
    const std::optional<Vec3> place = place_at(m);
    if (!place) return always;
    const Look look = look_at(*place);
    if (look == Look::last) return always;
    const bool hides = look == Look::hidden;
    if (hides && before_is_hidden) return seen_m;
    if (!hides) seen_m = m;
    before_is_hidden = hides;
  }
  return always;
}

/// True where a box stands before a place, which is this far along the line.
bool stands_before(const sight::Box& box, const sight::Line& line, double away_m) {
  const auto entry_m = sight::entry_m(box, line);
  return entry_m && *entry_m > 0.0 && *entry_m < away_m;
}

using SeenBack = std::array<double, looks_before_m.size()>;

/// What is seen of the way to his entry from each distance before the stop line of the way to mine.
SeenBack seen_from_each(const sight::Walls& walls, std::span<const std::uint32_t> gone, const LaneGraph& graph,
                        WayIndex mine, double line_before_m, WayIndex his) {
  SeenBack seen;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const auto place = place_before(graph, mine, looks_before_m[k] + line_before_m + eye_behind_m);
    const auto look_at = [&](const Vec3& there) {
      return walls.hide(*place + Vec3(0.0, 0.0, eye_height_m), there, gone) ? Look::hidden : Look::seen;
    };
    // Who begins nearer than that has seen nothing from there.
    const auto place_at = [&](double back_m) { return looked_for_at(graph, his, back_m); };
    seen[k] = place ? seen_back_m(place_at, most_back_m, look_at) : always;
  }
  return seen;
}

/// The farthest distance from which on enough is seen all the way to the line.
double seen_from(const SeenBack& seen, double needed_m) {
  double from_m = 0.0;
  for (std::size_t k = seen.size(); k-- > 0;) {
    if (seen[k] < needed_m) return from_m;
    from_m = looks_before_m[k];
  }
  return always;
}

/// What an eye meets on the way to a place.
Look look_past(std::span<const HighBody> bodies, const sight::OpticalDepth& air, const Vec3& eye_m, const Vec3& there) {
  const double away_m = glm::distance(eye_m, there);
  if (!(away_m > 0.0)) return Look::seen;
  const sight::Line line{eye_m, (there - eye_m) / away_m};
  bool is_hidden = false;
  for (const HighBody& body : bodies) {
    const bool is_within = sight::entry_m(body.box, {there, line.direction}) == 0.0;
    if (is_within && body.moves) return Look::last;
    // A place within a body is not behind it.
    is_hidden = is_hidden || (!is_within && stands_before(body.box, line, away_m));
  }
  // Who comes has his lamps lit.
  is_hidden = is_hidden || (air && air(eye_m, there) > sight::shining_depth);
  return is_hidden ? Look::hidden : Look::seen;
}

/// Places on the way to an entry at which one looks for somebody.
std::vector<Vec3> looked_for_places(const LaneGraph& graph, WayIndex entry, double back_m) {
  std::vector<Vec3> places;
  for (double m = 0.0; m <= back_m; m += look_step_m)
    if (const auto place = looked_for_at(graph, entry, m))
      places.push_back(*place);
    else
      break;
  return places;
}

}  // namespace

double critical_gap_s(const Way& way) {
  if (way.onto_ring) return 5.0;
  const double keeps = way.left_hand ? -1.0 : 1.0;
  const double left_rad = keeps * way.turns_rad;
  if (way.rank == Rank::priority || (way.rank == Rank::equal && left_rad > turns_from_rad)) return 4.1;
  return left_rad > turns_from_rad ? 7.1 : left_rad < -turns_from_rad ? 6.2 : 6.5;
}

double most_mps_on(const Way& way) {
  return std::min(way.limit_mps, std::sqrt(town_bend_mps2 / std::max(way.tightest_per_m, 1e-6)));
}

double looked_for_back_m(const Way& mine, const WayConflict& conflict, const Way& his) {
  const double within_m = his.from_entry_m + conflict.with_whole_from_m;
  return std::clamp(critical_gap_s(mine) * most_mps_on(his) - within_m, look_step_m, most_back_m);
}

void look_past_walls(const sight::Walls& walls, LaneGraph& graph, std::span<const std::uint32_t> gone) {
  // Connections share the roads by which they are reached.
  std::map<std::pair<WayIndex, WayIndex>, SeenBack> known;
  for (const Way& mine : graph.ways)
    for (std::uint32_t k = 0; k < mine.conflicts.count; ++k) {
      WayConflict& conflict = graph.conflicts[mine.conflicts.first + k];
      conflict.seen_from_m = always;
      const Way& his = graph.ways[conflict.with];
      if (walls.empty() || conflict.kind == WayConflict::Kind::diverging || !yields_to(mine, his)) continue;
      const WayIndex before = straight_before(graph, graph.ways[mine.entry]);
      const WayIndex his_before = straight_before(graph, graph.ways[his.entry]);
      if (before == no_way || his_before == no_way) continue;
      auto at = known.find({before, his_before});
      if (at == known.end()) {
        const Way& way = graph.ways[before];
        const double line_before_m = way.in_junction() ? 0.0 : way.line_before_m;
        at = known
                 .emplace(std::pair(before, his_before),
                          seen_from_each(walls, gone, graph, mine.entry, line_before_m, his.entry))
                 .first;
      }
      conflict.seen_from_m = seen_from(at->second, looked_for_back_m(mine, conflict, his));
    }
}

std::vector<ApproachView> approach_views(const road::RoadNetwork& network, const sight::Walls& walls,
                                         std::span<const std::uint32_t> gone) {
  std::vector<ApproachView> views;
  if (network.junctions.empty()) return views;
  LaneGraph graph = build_lane_graph(network);
  look_past_walls(walls, graph, gone);
  for (const Way& mine : graph.ways)
    for (const WayConflict& conflict : graph.conflicts_of(mine)) {
      const Way& his = graph.ways[conflict.with];
      if (conflict.kind == WayConflict::Kind::diverging || !yields_to(mine, his)) continue;
      auto view = std::ranges::find_if(
          views, [&](const ApproachView& other) { return other.road == mine.road && other.along_s == mine.along_s; });
      if (view == views.end()) view = views.insert(views.end(), {mine.road, mine.along_s, always, {}});
      view->seen_from_m = std::min(view->seen_from_m, conflict.seen_from_m);
      auto places = looked_for_places(graph, his.entry, looked_for_back_m(mine, conflict, his));
      if (std::ranges::find(view->looked_for_m, places) == view->looked_for_m.end())
        view->looked_for_m.push_back(std::move(places));
    }
  return views;
}

bool hides_behind(const VehicleModel& model) { return opaque_height_m(model) > eye_height_m; }

bool is_hidden_by(std::span<const HighBody> bodies, const sight::OpticalDepth& air, const LaneGraph& graph,
                  const Vec3& eye_m, const Way& his, double back_m) {
  const auto place_at = [&](double m) { return looked_for_at(graph, his.entry, m); };
  return seen_back_m(place_at, back_m, [&](const Vec3& there) { return look_past(bodies, air, eye_m, there); }) <
         back_m;
}

bool is_hidden_by(std::span<const HighBody> bodies, const ApproachView& view, const Vec3& eye_m) {
  return std::ranges::any_of(view.looked_for_m, [&](const std::vector<Vec3>& places) {
    const auto place_at = [&](double m) {
      const auto k = static_cast<std::size_t>(std::lround(m / look_step_m));
      return k < places.size() ? std::optional(places[k]) : std::nullopt;
    };
    return seen_back_m(place_at, most_back_m, [&](const Vec3& there) { return look_past(bodies, {}, eye_m, there); }) <
           always;
  });
}

}  // namespace septet::traffic

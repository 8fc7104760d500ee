#pragma once
/// Where people walk in a road network: pavements, round the corners of junctions, and across roads.
///
/// A walk is a ribbon along a middle line: a pavement along one side of a road (lanes of type `sidewalk`; OpenDRIVE 1.8
/// calls shared and walking lanes so too, table of e_laneType), round a corner, or a crossing. Walks meet at nodes, where people choose
/// where to go on; a pavement is parted where a crossing begins. Crossings are objects of type `crosswalk` (§13 of the
/// standard) with pavements at both ends; lights for people (1000002) that hang within 8 m of one are its own. Where a
/// road with pavements ends at a junction without a crosswalk, and is narrow, people cross as well, without right of way.
///
/// Built once, at load, from roads and what the roadside adds to them; then const, safe from many threads. World frame,
/// metres. Time and memory grow with the length of the pavements.

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "engine/math/rigid_transform.hpp"
#include "engine/road/road_network.hpp"
#include "engine/traffic/crossing.hpp"
#include "engine/world/traffic_light.hpp"

namespace septet::traffic {

using WalkIndex = std::uint32_t;
using NodeIndex = std::uint32_t;
inline constexpr std::uint32_t no_walk = 0xFFFF'FFFFu;

/// Entries [first, first + count) of one of the graph's arrays.
struct WalkRange {
  std::uint32_t first = 0, count = 0;
};

struct WalkPoint {
  Vec3 middle_m{0.0};
  Vec2 along{1.0, 0.0};  ///< Unit, from the walk's begin to its end.
  double at_m = 0.0;     ///< From the begin, in plan.
  double half_m = 0.0;   ///< Half of the ribbon's width.
  double rises = 0.0;    ///< Of its surface by the metre to the left.
};

struct Walk {
  WalkRange points;  ///< At least two.
  double length_m = 0.0;
  NodeIndex begin = 0, end = 0;
  std::uint32_t crossing = no_walk;  ///< Index of the crossing that it is; no_walk: a pavement or a corner.
  WalkRange posts;

  bool is_crossing() const { return crossing != no_walk; }
};

struct Crossing {
  enum class Kind : std::uint8_t {
    zebra,  ///< Who walks has right of way.
    light,  ///< By lights for people.
    plain,  ///< No right of way: people wait for a gap.
  };
  Kind kind = Kind::zebra;
  CrossingPlace place;
  WalkIndex walk = 0;     ///< It begins on the pavement to the left of the road.
  Vec2 left_kerb_m{0.0};  ///< Ends of the carriageway.
  Vec2 right_kerb_m{0.0};
  double left_at_m = 0.0;  ///< The kerbs' places along the walk.
  double right_at_m = 0.0;
  WalkRange heads;  ///< Of a light: indices of heads, in `WalkwayGraph::heads`.
};

/// A trunk, a pole, or the like, in or beside a ribbon.
struct WalkPost {
  Vec2 at_m{0.0};
  double radius_m = 0.1;
};

/// One of the walks that meet at a node.
struct WalkEnd {
  WalkIndex walk = 0;
  bool is_begin = true;
};

struct WalkNode {
  Vec3 at_m{0.0};
  WalkRange ends;
};

struct WalkwayGraph {
  std::vector<Walk> walks;
  std::vector<WalkPoint> points;
  std::vector<WalkNode> nodes;
  std::vector<WalkEnd> ends;
  std::vector<Crossing> crossings;
  std::vector<std::uint32_t> heads;
  std::vector<WalkPost> posts;

  bool empty() const { return walks.empty(); }
  std::span<const WalkPoint> points_of(const Walk& walk) const {
    return {points.data() + walk.points.first, walk.points.count};
  }
  std::span<const WalkPost> posts_of(const Walk& walk) const {
    return {posts.data() + walk.posts.first, walk.posts.count};
  }
  std::span<const WalkEnd> ends_of(const WalkNode& node) const {
    return {ends.data() + node.ends.first, node.ends.count};
  }
  std::span<const std::uint32_t> heads_of(const Crossing& crossing) const {
    return {heads.data() + crossing.heads.first, crossing.heads.count};
  }
};

/// Pavement round a corner: its two edges, with equally many points.
struct CornerPavement {
  std::vector<Vec3> kerb_m, edge_m;
};

/// What the roadside adds to the roads.
struct WalkwaySurroundings {
  std::vector<CornerPavement> corners;
  std::vector<WalkPost> posts;
  std::vector<TrafficLight> lights;  ///< In the order in which they are shown in each tick (lit_heads).
  /// Height of the ground where the road's surface lies that high: islands and kerbs that are objects. May be empty.
  std::function<double(const Vec2&, double)> ground_m;
};

WalkwayGraph build_walkways(const road::RoadNetwork& network, const WalkwaySurroundings& surroundings);

/// A place of a ribbon: on its middle line, which goes straight on beyond its ends.
struct PlaceOnWalk {
  Vec3 middle_m{0.0};
  Vec2 along{1.0, 0.0};
  double half_m = 0.0, rises = 0.0;
};
PlaceOnWalk place_on_walk(const WalkwayGraph& graph, const Walk& walk, double at_m);

/// The inverse: the nearest place of a ribbon to a point, sought around `near_m`; below 0 and beyond the length it lies
/// before its begin and beyond its end.
struct OnWalk {
  double at_m = 0.0, left_m = 0.0;
};
OnWalk locate_on_walk(const WalkwayGraph& graph, const Walk& walk, const Vec2& p_m, double near_m);

}  // namespace septet::traffic
